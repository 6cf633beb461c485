#include "app/cli/run_scene.hpp"

#include "fascicle/base/interrupt.hpp"
#include "fascicle/io/disk_cache.hpp"

#include <chrono>
#include <thread>

namespace fascicle::app {

RecordingPtr run_scene(ScenePtr scene, const RunSceneOptions& options, ProgressDisplay& progress,
                       const std::function<void(const Recording&, const FramePtr&)>& on_frame) {
    const std::atomic<bool>& interrupted = watch_interrupts();
    const int total = scene->timeline.last_frame;
    SimulationThread simulation(std::move(scene), {options.threads, open_cache(), options.notes});
    RecordingPtr recording = simulation.recording();

    int taken = 0;
    for (bool done = false; !done;) {
        done = simulation.done(); // asked first: what was appended before it is seen below
        if (interrupted)
            simulation.cancel();
        for (; taken < recording->frame_count(); ++taken) {
            on_frame(*recording, recording->frame(taken));
            if (interrupted)
                simulation.cancel();
            const int solved = taken;
            progress.update({"solve", total > 0 ? double(solved) / total : 1.0, solved, total},
                            steady_seconds());
        }
        if (taken == 0) {
            const auto [stage, fraction] = simulation.progress();
            if (!stage.empty())
                progress.update({stage, fraction, 0, 0}, steady_seconds());
        }
        if (!done)
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    progress.finish();
    if (recording->state() == RunState::failed)
        throw Error(recording->failure());
    return recording;
}

double steady_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

} // namespace fascicle::app
