#pragma once
// A simulation under way, as the editor sees it, and how one is started. Tests start their own kind.

#include "fascicle/scene/recording.hpp"

#include <functional>
#include <utility>

namespace fascicle::editor {

class Run {
public:
    virtual ~Run() = default; ///< may wait for the run to stop; see done()
    virtual RecordingPtr recording() const = 0;
    virtual void cancel() = 0;
    virtual bool done() const = 0;
    /// Stage and its share done, 0 to 1.
    virtual std::pair<std::string, double> progress() const = 0;
};

using StartRun = std::function<std::unique_ptr<Run>(ScenePtr)>;

/// Runs on a SimulationThread with `threads` solver threads; 0: all of the machine but one.
StartRun simulate_on_thread(int threads = 0);

} // namespace fascicle::editor
