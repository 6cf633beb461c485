#include "bench/prepare_bench.hpp"

#include "fascicle/io/disk_cache.hpp"
#include "fascicle/simulation/scene_solver.hpp"

#include <chrono>
#include <filesystem>
#include <unistd.h>

namespace fascicle::bench {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// An empty folder as long as this lives.
class OwnFolder {
public:
    OwnFolder() : path_(fs::temp_directory_path() / ("fascicle-bench-" + std::to_string(::getpid()))) {
        clear();
    }
    ~OwnFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    OwnFolder(const OwnFolder&) = delete;
    OwnFolder& operator=(const OwnFolder&) = delete;

    void clear() {
        fs::remove_all(path_);
        fs::create_directories(path_);
    }
    const fs::path& path() const { return path_; }

private:
    fs::path path_;
};

std::map<std::string, double> prepare_once(const std::function<Scene(int threads)>& read_scene,
                                           const Variant& variant, int threads, const fs::path& folder,
                                           const JobControl& control) {
    JobControl silent;
    silent.cancel = control.cancel;
    auto start = Clock::now();
    Scene scene = read_scene(threads);
    apply(variant, scene.parameters);
    const double read = seconds_since(start);
    DiskCache cache(folder);
    const PreparedScene prepared = prepare_scene(scene, threads, silent, &cache);
    std::map<std::string, double> stages = prepared.stage_seconds;
    stages["read"] = read;
    start = Clock::now();
    const SceneSolver solver(scene, prepared, threads);
    stages["solvers"] = seconds_since(start);
    return stages;
}

} // namespace

std::vector<PrepareRow> measure_prepare(const std::string& name,
                                        const std::function<Scene(int threads)>& read, const Variant& variant,
                                        const std::vector<int>& threads, int runs,
                                        const JobControl& control) {
    OwnFolder folder;
    std::vector<PrepareRow> rows;
    for (const int count : threads)
        for (const bool warm : {false, true}) {
            PrepareRow row;
            row.case_name = name;
            row.threads = count;
            std::vector<double> seconds;
            std::map<std::string, std::vector<double>> stages;
            for (int r = 0; r < runs; ++r) {
                control.checkpoint("prepare: " + name + ", threads " + std::to_string(count) +
                                       (warm ? ", warm" : ""),
                                   double(r) / runs);
                if (!warm)
                    folder.clear();
                const auto start = Clock::now();
                const auto spent = prepare_once(read, variant, count, folder.path(), control);
                seconds.push_back(seconds_since(start));
                for (const auto& [stage, value] : spent)
                    stages[stage].push_back(value);
            }
            row.seconds = spread_of(seconds);
            for (const auto& [stage, values] : stages)
                row.stage_seconds[stage] = spread_of(values).median;
            row.cache = warm ? "warm" : fs::is_empty(folder.path()) ? "none" : "cold";
            rows.push_back(row);
            if (row.cache == "none")
                break;
        }
    return rows;
}

} // namespace fascicle::bench
