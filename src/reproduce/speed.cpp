#include "reproduce/speed.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/io/run_writer.hpp"
#include "fascicle/simulation/simulation.hpp"
#include "fascicle/solver/soft_body_solver.hpp"
#include "reproduce/statistics.hpp"

#include <algorithm>
#include <map>

namespace fascicle::reproduce {

std::vector<SpeedResult::Correlation> speed_correlations(const std::vector<SpeedRow>& rows) {
    std::map<std::pair<std::string, int>, std::pair<std::vector<double>, std::vector<double>>> groups;
    for (const SpeedRow& row : rows) {
        auto& [triangles, speeds] = groups[{row.method, row.threads}];
        triangles.push_back(static_cast<double>(row.triangles));
        speeds.push_back(row.frames_per_second);
    }
    std::vector<SpeedResult::Correlation> result;
    for (const auto& [key, lists] : groups)
        result.push_back({key.first, key.second, lists.first.size(), spearman(lists.first, lists.second)});
    return result;
}

SpeedResult measure_speed(const std::vector<SpeedObject>& objects, const std::vector<std::string>& methods,
                          int threads, int frames, const std::shared_ptr<BlobStore>& cache,
                          const JobControl& control) {
    SpeedResult result;
    std::vector<int> counts{1};
    if (threads > 1)
        counts.push_back(threads);
    const std::size_t runs = std::max<std::size_t>(1, objects.size() * methods.size() * counts.size());
    std::size_t run = 0;
    for (const SpeedObject& object : objects)
        for (const std::string& method : methods)
            for (const int count : counts) {
                const double share = static_cast<double>(run++) / static_cast<double>(runs);
                if (count > 1 && method == "classic")
                    continue; // steps on one thread, as the published program
                auto scene = std::make_shared<Scene>(object.scene);
                set_method(scene->parameters, method);
                // Fibres are made once before the first frame and carried outside of the time that counts.
                scene->timeline.last_frame = std::min(frames, scene->timeline.last_frame);
                Recording recording(scene);
                JobControl inner = control;
                inner.report = [&](std::string_view, double fraction) {
                    if (control.report)
                        control.report("speed", share + fraction / static_cast<double>(runs));
                };
                try {
                    run_simulation(recording, {count, cache}, inner);
                } catch (const Error& error) {
                    result.failures.push_back(object.name + ", " + method + ": " + error.what());
                    continue;
                }
                if (recording.state() == RunState::cancelled)
                    throw Cancelled();
                result.rows.push_back(
                    {object.name, method, object.real,
                     static_cast<std::size_t>(scene->muscles.front().mesh->triangle_count()), count,
                     passes_per_frame(scene->parameters), run_speed(recording).fps_median});
            }
    result.correlations = speed_correlations(result.rows);
    return result;
}

} // namespace fascicle::reproduce
