#include "fascicle/metrics/line_series.hpp"

#include "fascicle/metrics/line_tracker.hpp"
#include "fascicle/metrics/moment_arm.hpp"

namespace fascicle {

namespace {

void append(LineSeries& series, LineTracker& tracker, int frame, std::span<const Pose> poses,
            double angle_rad, double unit_mm) {
    tracker.set_frame(poses, angle_rad, frame);
    series.frames.push_back(frame);
    series.angles_rad.push_back(angle_rad);
    for (std::size_t m = 0; m < tracker.muscle_count(); ++m) {
        const LineState state = tracker.measure(m);
        series.lengths_mm.push_back(unit_mm * state.length);
        series.moment_arms_mm.push_back(unit_mm * state.moment_arm);
        for (const int c : tracker.coordinates())
            series.coordinate_arms_mm.push_back(unit_mm * tracker.moment_arm_about(m, c));
    }
}

void finish(LineSeries& series, const LineTracker& tracker, const Scene& scene) {
    for (std::size_t m = 0; m < tracker.muscle_count(); ++m)
        series.muscles.push_back(tracker.muscle_name(m));
    for (const int c : tracker.coordinates())
        series.coordinates.push_back(
            scene.line_muscles->model->skeleton.coordinates[static_cast<std::size_t>(c)].name);
    series.exact_arms = tracker.exact();
    if (!series.exact_arms)
        series.moment_arms_mm = excursion_arms(series.angles_rad, series.lengths_mm,
                                               static_cast<int>(series.muscles.size()), flexion_sign(scene));
}

} // namespace

LineSeries line_series(const Recording& recording) {
    const Scene& scene = recording.scene();
    LineSeries series;
    if (scene.line_muscles == nullptr)
        return series;
    LineTracker tracker(scene);
    for (int k = 0; k < recording.frame_count(); ++k) {
        const FramePtr frame = recording.frame(k);
        append(series, tracker, frame->index, frame->bone_poses, frame->angle_rad,
               millimetres_per_unit(scene.unit));
    }
    finish(series, tracker, scene);
    return series;
}

LineSeries line_series(const Scene& scene) {
    LineSeries series;
    if (scene.line_muscles == nullptr)
        return series;
    LineTracker tracker(scene);
    std::vector<Pose> poses(scene.bones.size());
    for (int k = 0; k <= scene.timeline.last_frame; ++k) {
        for (std::size_t b = 0; b < poses.size(); ++b)
            poses[b] = scene.timeline.bone_pose(static_cast<int>(b), k);
        append(series, tracker, k, poses, scene.timeline.angle_rad(k), millimetres_per_unit(scene.unit));
    }
    finish(series, tracker, scene);
    return series;
}

} // namespace fascicle
