#include "bench/fibre_bench.hpp"

#include "fascicle/anatomy/fibre_methods.hpp"
#include "fascicle/simulation/muscle_fibres.hpp"
#include "fascicle/simulation/scene_solver.hpp"

#include <chrono>
#include <cmath>

namespace fascicle::bench {

namespace {

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// The first frame in which the joint is bent furthest.
int furthest_frame(const Timeline& timeline) {
    int best = 0;
    for (int frame = 1; frame <= timeline.last_frame; ++frame)
        if (std::abs(timeline.angle_rad(frame)) > std::abs(timeline.angle_rad(best)) + 1e-12)
            best = frame;
    return best;
}

/// The muscles' positions there.
std::vector<Points> bent_positions(const Scene& scene, const PreparedScene& prepared, int threads,
                                   bool is_short, const JobControl& control) {
    PreparedScene own = prepared;
    for (PreparedMuscle& muscle : own.muscles)
        muscle.problem.parameters.set("solver.iterations", 3);
    SceneSolver solver(scene, own, threads);
    const int last = is_short ? std::min(2, scene.timeline.last_frame) : furthest_frame(scene.timeline);
    for (int frame = 1; frame <= last; ++frame) {
        control.checkpoint("fibres", double(frame) / last);
        solver.advance(bone_poses(scene, frame - 1), bone_poses(scene, frame));
    }
    std::vector<Points> positions;
    for (std::size_t m = 0; m < solver.muscle_count(); ++m)
        positions.push_back(solver.muscle(m).positions());
    return positions;
}

Spread carry_time(const FibreModel& model, const Points& surface, int runs) {
    constexpr int frames = 50;
    Points points = model.rest.points;
    std::vector<double> times;
    for (int r = 0; r < runs; ++r) {
        const auto start = Clock::now();
        for (int k = 0; k < frames; ++k)
            model.carrier.carry(surface, points);
        times.push_back(milliseconds_since(start) / frames);
    }
    return spread_of(times);
}

} // namespace

std::vector<LimitRow> measure_fibres(const Scene& scene, const PreparedScene& prepared, int threads, int runs,
                                     bool is_short, const JobControl& control) {
    std::vector<LimitRow> rows;
    const std::vector<Points> bent = bent_positions(scene, prepared, threads, is_short, control);
    for (std::size_t m = 0; m < scene.muscles.size(); ++m) {
        const Muscle& muscle = scene.muscles[m];
        const TriMesh& rest = *prepared.muscles[m].problem.surface;
        const MeshTopology topology(rest.vertex_count(), rest.triangles);
        for (const FibreMethod& method : fibre_methods()) {
            if (method.needs_surface_fibres && muscle.surface_fibres == nullptr)
                continue;
            Scene own = scene;
            own.parameters.set_text("fibres.method", method.key);
            std::vector<double> all, after_field;
            FibreModelPtr model;
            for (int r = 0; r < runs; ++r) {
                control.checkpoint("fibres", double(r) / runs);
                const auto start = Clock::now();
                model = make_fibres(own, muscle, rest, topology, prepared.muscles[m].attachments, threads);
                all.push_back(milliseconds_since(start));
                after_field.push_back(0);
                for (const auto& [stage, seconds] : model->seconds)
                    after_field.back() += stage == "field" ? 0.0 : 1000 * seconds;
            }
            const std::string name = muscle.name + ", " + method.key;
            rows.push_back({name + ": decomposition", "ms", threads, spread_of(all)});
            rows.push_back({name + ": without the field", "ms", threads, spread_of(after_field)});
            rows.push_back({name + ": carrying, at rest", "ms", 1, carry_time(*model, rest.positions, runs)});
            rows.push_back({name + ": carrying, bent", "ms", 1, carry_time(*model, bent[m], runs)});
        }
    }
    return rows;
}

} // namespace fascicle::bench
