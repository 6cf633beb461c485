#pragma once
// A run that somebody at a terminal waits for: solved on a thread of its own, followed on this one.

#include "app/cli/progress.hpp"
#include "fascicle/simulation/simulation.hpp"

namespace fascicle::app {

struct RunSceneOptions {
    int threads = 1;
    std::vector<std::string> notes; ///< go into the recording's notes
};

/// Runs the scene and hands every frame, in order and as soon as it is solved, to `on_frame` on this thread.
/// SIGINT and SIGTERM end the run after the frame under way: the recording's state is then `cancelled`, and
/// on_frame has seen all of its frames. Throws what on_frame throws (the run is stopped), and an Error when the
/// simulation fails.
RecordingPtr run_scene(ScenePtr scene, const RunSceneOptions& options, ProgressDisplay& progress,
                       const std::function<void(const Recording&, const FramePtr&)>& on_frame);

/// Seconds on a steady clock, for ProgressDisplay::update.
double steady_seconds();

} // namespace fascicle::app
