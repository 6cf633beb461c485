#pragma once
// A run that a test feeds frame by frame, and a small scene for it. Knows nothing of windows.

#include "editor/run.hpp"

namespace fascicle::test {

/// A run that the test feeds by hand.
class HandRun : public editor::Run {
public:
    explicit HandRun(ScenePtr scene) : recording_(std::make_shared<Recording>(std::move(scene))) {}
    RecordingPtr recording() const override { return recording_; }
    void cancel() override { cancelled = true; }
    bool done() const override { return cancelled || finished; }
    std::pair<std::string, double> progress() const override { return {"solve", 0.5}; }

    /// Appends frames until there are `count`: rest shapes, shifted a little a frame; bones where the timeline has them.
    void compute(int count);
    void finish();

    bool cancelled = false, finished = false;

private:
    RecordingPtr recording_;
};

/// One bone at rest, one that turns by 1 rad over 30 frames and back, one muscle (a sphere) between them.
Scene small_scene();
/// A finished recording of small_scene() (or another) with `count` frames.
RecordingPtr small_recording(int count = 61, const Scene& scene = small_scene());

} // namespace fascicle::test
