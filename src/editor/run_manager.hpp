#pragma once
// Which results there are for the scene being edited: the run under way, and the one before it, whose frames
// stay visible (stale) until the new ones come.

#include "editor/run.hpp"

#include <vector>

namespace fascicle::editor {

enum class FrameState { valid, stale, missing };

/// What can be shown at a frame of the timeline.
struct ShownFrame {
    FramePtr frame;         ///< null when missing
    RecordingPtr recording; ///< that it belongs to
    FrameState state = FrameState::missing;
};

class RunManager {
public:
    /// start: null when recordings are only shown, never made.
    explicit RunManager(StartRun start);
    ~RunManager();
    RunManager(const RunManager&) = delete;
    RunManager& operator=(const RunManager&) = delete;

    /// Seconds without a change of the scene before a new run starts.
    static constexpr double settle_seconds = 0.25;

    /// Once a frame. head: the committed scene; held: a change is under way (a slider is down); now: seconds
    /// of any steady clock. Never waits for a run.
    void update(const ScenePtr& head, bool held, double now);
    /// Shows a recording instead of running its scene.
    void show(RecordingPtr recording);
    /// As if nothing had ever run: another document was opened. A run under way is stopped.
    void forget();
    /// Starts from rest at once.
    void restart();
    /// Goes on after a stop: the same frames come again in the background, bit by bit the same, so those there are stay valid.
    /// Nothing unless the run of the present scene was stopped.
    void compute_on();
    /// Stops the run; it is not started again by itself until the scene changes.
    void cancel();

    bool running() const;
    /// A changed scene waits for its run: every frame there is, is stale.
    bool outdated() const { return outdated_; }
    std::pair<std::string, double> progress() const;
    /// Seconds that the run has taken so far, 0 without one.
    double elapsed(double now) const { return running() ? now - started_ : 0.0; }

    RecordingPtr recording() const { return recording_; } ///< the newest, null before the first
    RecordingPtr previous() const { return previous_; }   ///< whose frames stand in, or null

    /// What to show at frame k >= 0 of the timeline.
    ShownFrame at(int k) const;
    /// The last frame not after k that can be shown.
    ShownFrame at_or_before(int k) const;
    int valid_count() const;     ///< frames [0, n) are valid
    int available_count() const; ///< frames [valid_count(), n) are stale

private:
    void begin(double now);
    /// Bodies that were renamed are called so in what is shown, too.
    void take_names();
    void retire();

    StartRun start_;
    ScenePtr head_;
    std::unique_ptr<Run> run_;
    std::vector<std::unique_ptr<Run>> retired_; ///< told to stop, waited for without blocking
    RecordingPtr recording_, previous_;
    bool previous_same_ = false; ///< its frames are those of the present scene, too
    bool outdated_ = false;
    bool stopped_ = false; ///< by the user
    double changed_ = 0, started_ = 0, now_ = 0;
};

/// Whether the frames of one scene can stand in for the other's: the same meshes in the same order.
bool same_bodies(const Scene& a, const Scene& b);

} // namespace fascicle::editor
