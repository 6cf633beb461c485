#pragma once
// Runs a scene: prepares (attachments, distance grids, constraints), then solves frame by frame into a
// Recording.

#include "fascicle/base/blob_store.hpp"
#include "fascicle/base/job_control.hpp"
#include "fascicle/scene/recording.hpp"

#include <memory>
#include <thread>
#include <utility>

namespace fascicle {

struct SimulationOptions {
    int threads = 1;
    /// Where distance grids are looked for and left, so that the next run of the same bones need not make them;
    /// changes nothing in the result. May be null.
    std::shared_ptr<BlobStore> cache = {};
    /// What loading had to say: the first notes of the recording, whatever the thread of the run does meanwhile.
    std::vector<std::string> notes = {};
};

/// Runs to the end, on this thread. The recording receives notes, attachments, frame 0 (rest) and then every
/// frame as soon as it is done; its state tells how it ended. Reports stages "prepare" and "solve".
/// Cancelling is no error: the frames so far stay. Errors of the scene (open muscle, no vertices left free)
/// finish the recording as failed and are rethrown.
void run_simulation(Recording& recording, const SimulationOptions& options, const JobControl& control);

/// The same on a thread of its own; the destructor cancels and joins.
class SimulationThread {
public:
    SimulationThread(ScenePtr scene, SimulationOptions options);
    ~SimulationThread();
    SimulationThread(const SimulationThread&) = delete;
    SimulationThread& operator=(const SimulationThread&) = delete;

    RecordingPtr recording() const { return recording_; }
    void cancel() { cancel_ = true; }
    bool done() const { return done_; }
    /// Stage and its share done, 0 to 1, for a progress bar.
    std::pair<std::string, double> progress() const;

private:
    RecordingPtr recording_;
    std::atomic<bool> cancel_{false};
    std::atomic<bool> done_{false};
    mutable std::mutex mutex_;
    std::string stage_;
    double fraction_ = 0;
    std::thread thread_;
};

} // namespace fascicle
