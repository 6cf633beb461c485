#include "editor/run.hpp"

#include "fascicle/base/parallel.hpp"
#include "fascicle/io/disk_cache.hpp"
#include "fascicle/simulation/simulation.hpp"

#include <algorithm>

namespace fascicle::editor {

namespace {

class ThreadRun : public Run {
public:
    ThreadRun(ScenePtr scene, int threads) : thread_(std::move(scene), make_options(threads)) {}
    RecordingPtr recording() const override { return thread_.recording(); }
    void cancel() override { thread_.cancel(); }
    bool done() const override { return thread_.done(); }
    std::pair<std::string, double> progress() const override { return thread_.progress(); }

private:
    static SimulationOptions make_options(int threads) {
        SimulationOptions options;
        options.threads = threads > 0 ? threads : std::max(1, hardware_threads() - 1);
        options.cache = open_cache();
        return options;
    }
    SimulationThread thread_;
};

} // namespace

StartRun simulate_on_thread(int threads) {
    return [threads](ScenePtr scene) -> std::unique_ptr<Run> {
        return std::make_unique<ThreadRun>(std::move(scene), threads);
    };
}

} // namespace fascicle::editor
