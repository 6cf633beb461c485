#include "bench/frame_bench.hpp"

#include "fascicle/base/state_hash.hpp"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <numeric>

namespace fascicle::bench {

namespace {

using Clock = std::chrono::steady_clock;

class SceneBody final : public BenchBody {
public:
    SceneBody(const Scene& scene, const PreparedScene& prepared, int threads)
        : solver_(scene, prepared, threads) {}
    void advance(std::span<const Pose> from, std::span<const Pose> to) override { solver_.advance(from, to); }
    std::vector<Points> positions() const override {
        std::vector<Points> all;
        for (std::size_t m = 0; m < solver_.muscle_count(); ++m)
            all.push_back(solver_.muscle(m).positions());
        return all;
    }
    std::map<std::string, double> stage_seconds() const override { return solver_.report().stage_seconds; }
    std::optional<std::size_t> state_bytes() const override { return solver_.state_bytes(); }

private:
    SceneSolver solver_;
};

/// Seconds of the frames 1 .. frames.
double run(BenchBody& body, const std::vector<std::vector<Pose>>& poses, int frames,
           const JobControl& control) {
    const auto start = Clock::now();
    for (std::size_t k = 1; k <= static_cast<std::size_t>(frames); ++k) {
        if (control.cancelled())
            throw Cancelled();
        body.advance(poses[k - 1], poses[k]);
    }
    return std::chrono::duration<double>(Clock::now() - start).count();
}

std::string hash_of(const BenchBody& body) {
    StateHash hash;
    for (const Points& points : body.positions())
        hash.add_points(points);
    return hash.hex();
}

int triangle_count(const Scene& scene) {
    int count = 0;
    for (const Muscle& muscle : scene.muscles)
        count += muscle.mesh->triangle_count();
    return count;
}

} // namespace

int frames_of(const Scene& scene, const RunSettings& settings) {
    const int last = scene.timeline.last_frame;
    return settings.frames > 0 ? std::min(settings.frames, last) : last;
}

MakeBody scene_body(const Scene& scene, const PreparedScene& prepared, const Variant& variant) {
    return [&scene, &prepared, variant]() -> std::unique_ptr<BenchBody> {
        PreparedScene own = prepared;
        for (PreparedMuscle& muscle : own.muscles)
            apply(variant, muscle.problem.parameters);
        return std::make_unique<SceneBody>(scene, own, variant.threads);
    };
}

FrameRow time_frames(const Scene& scene, const MakeBody& make, const Variant& variant,
                     const RunSettings& settings, const JobControl& control, const std::string& stage) {
    const int frames = frames_of(scene, settings);
    std::vector<std::vector<Pose>> poses;
    for (int k = 0; k <= frames; ++k)
        poses.push_back(bone_poses(scene, k));
    control.checkpoint(stage, 0.0);
    run(*make(), poses, std::min(settings.warm_up_frames, frames), control);

    FrameRow row;
    row.method = variant.name;
    row.threads = variant.threads;
    row.passes = variant.passes;
    std::vector<double> seconds;
    double processor = 0;
    std::map<std::string, std::vector<double>> stages;
    for (int r = 0; r < settings.runs; ++r) {
        control.checkpoint(stage, double(r) / settings.runs);
        const std::unique_ptr<BenchBody> body = make();
        const std::clock_t before = std::clock(); // of all threads
        seconds.push_back(run(*body, poses, frames, control));
        processor += double(std::clock() - before) / CLOCKS_PER_SEC;
        for (const auto& [name, spent] : body->stage_seconds())
            stages[name].push_back(spent);
        if (r + 1 < settings.runs)
            continue;
        row.state_hash = hash_of(*body);
        if (const auto bytes = body->state_bytes())
            row.bytes_per_triangle = double(*bytes) / std::max(1, triangle_count(scene));
    }
    const double passes = double(frames) * variant.passes;
    row.rate = spread_of_rates(frames, seconds);
    row.processor_share =
        processor / (variant.threads * std::accumulate(seconds.begin(), seconds.end(), 0.0));
    for (const double s : seconds)
        row.run_rates.push_back(frames / s);
    row.pass_us = 1e6 * spread_of(seconds).median / passes;
    for (const auto& [name, spent] : stages)
        row.stage_us[name] = 1e6 * spread_of(spent).median / passes;
    return row;
}

} // namespace fascicle::bench
