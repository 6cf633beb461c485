#pragma once
// Frames a second of one variant on one scene.

#include "bench/bench_body.hpp"
#include "bench/report.hpp"
#include "bench/variants.hpp"
#include "fascicle/base/job_control.hpp"

namespace fascicle::bench {

struct RunSettings {
    int runs = 5;
    int frames = 0; ///< of one run; 0: the whole timeline of the scene
    int warm_up_frames = 20;
};

int frames_of(const Scene& scene, const RunSettings& settings);

/// The scene's solvers of one variant, at rest. prepared: for the variant's method; kept, not copied.
MakeBody scene_body(const Scene& scene, const PreparedScene& prepared, const Variant& variant);

/// Every run starts from rest with new solvers and advances the scene's frames 1 .. n; only the frames are timed, and a
/// warm-up before the first run is not. progress: called between runs with the share done. Throws Cancelled.
FrameRow time_frames(const Scene& scene, const MakeBody& make, const Variant& variant,
                     const RunSettings& settings, const JobControl& control, const std::string& stage);

} // namespace fascicle::bench
