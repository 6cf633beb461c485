#include "fascicle/motion/timeline.hpp"

#include "fascicle/base/error.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fascicle {

namespace {

void check_phases(const Phases& p) {
    if (p.out < 0 || p.back < 0 || p.rest < 0 || p.out > 1000000 || p.back > 1000000 || p.rest > 1000000 ||
        p.total() < 1)
        throw_error("--phases",
                    "got " + std::to_string(p.out) + "," + std::to_string(p.back) + "," +
                        std::to_string(p.rest),
                    "three frame counts from 0 to 1000000, not all 0", ErrorKind::usage);
}

} // namespace

Pose BoneTrack::sample(double frame) const {
    if (keys.empty())
        return {};
    const auto next = std::upper_bound(keys.begin(), keys.end(), frame,
                                       [](double f, const PoseKey& key) { return f < key.frame; });
    if (next == keys.begin())
        return keys.front().pose;
    if (next == keys.end())
        return keys.back().pose;
    const PoseKey& a = *(next - 1);
    return screw_between(a.pose, next->pose, (frame - a.frame) / (next->frame - a.frame));
}

bool BoneTrack::moves() const {
    return std::any_of(keys.begin(), keys.end(), [](const PoseKey& key) { return !key.pose.is_identity(); });
}

Pose Timeline::bone_pose(int bone, double frame) const {
    const auto index = static_cast<std::size_t>(bone);
    return index < bone_tracks.size() ? bone_tracks[index].sample(frame) : Pose{};
}

double Timeline::angle_rad(double frame) const {
    if (angles.empty())
        return 0.0;
    const auto next = std::upper_bound(angles.begin(), angles.end(), frame,
                                       [](double f, const AngleKey& key) { return f < key.frame; });
    if (next == angles.begin())
        return angles.front().angle_rad;
    if (next == angles.end())
        return angles.back().angle_rad;
    const AngleKey& a = *(next - 1);
    return a.angle_rad + (next->angle_rad - a.angle_rad) * (frame - a.frame) / (next->frame - a.frame);
}

Timeline make_hinge_timeline(const Hinge& hinge, double angle_rad, const Phases& phases, int bone_count,
                             const std::vector<int>& moving) {
    check_phases(phases);
    Timeline timeline;
    timeline.last_frame = phases.total();
    timeline.hinge = hinge;
    timeline.angles.push_back({0, 0});
    if (phases.out > 0)
        timeline.angles.push_back({double(phases.out), angle_rad});
    if (phases.out > 0 && phases.back > 0)
        timeline.angles.push_back({double(phases.out + phases.back), 0});
    BoneTrack track;
    const int steps =
        std::max(1, static_cast<int>(std::ceil(std::abs(angle_rad) / (0.5 * std::numbers::pi))));
    track.keys.push_back({0, Pose{}});
    for (std::size_t i = 1; i < timeline.angles.size(); ++i)
        for (int k = 1; k <= steps; ++k) {
            const AngleKey &a = timeline.angles[i - 1], &b = timeline.angles[i];
            const double s = double(k) / steps;
            const double angle = a.angle_rad + s * (b.angle_rad - a.angle_rad);
            track.keys.push_back({a.frame + s * (b.frame - a.frame),
                                  angle == 0.0 ? Pose{} : rotation_about(hinge.centre, hinge.axis, angle)});
        }
    timeline.bone_tracks.resize(static_cast<std::size_t>(bone_count));
    for (const int bone : moving)
        timeline.bone_tracks.at(static_cast<std::size_t>(bone)) = track;
    return timeline;
}

Timeline make_shift_timeline(const Vec3& shift, const Phases& phases, int bone_count, int moving) {
    check_phases(phases);
    Timeline timeline;
    timeline.last_frame = phases.total();
    timeline.bone_tracks.resize(static_cast<std::size_t>(bone_count));
    auto& keys = timeline.bone_tracks.at(static_cast<std::size_t>(moving)).keys;
    keys.push_back({0, Pose{}});
    if (phases.out > 0)
        keys.push_back({double(phases.out), Pose{Mat3::Identity(), shift}});
    if (phases.out > 0 && phases.back > 0)
        keys.push_back({double(phases.out + phases.back), Pose{}});
    return timeline;
}

} // namespace fascicle
