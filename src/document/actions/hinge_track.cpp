#include "document/actions/hinge_track.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::actions {

void give_hinge_track(Scene& scene, std::size_t bone) {
    Timeline& timeline = scene.timeline;
    if (!timeline.hinge)
        return;
    constexpr double largest_step = 0.78; // below pi / 4
    BoneTrack track;
    const auto add = [&](double frame, double angle) {
        const Pose pose =
            angle == 0 ? Pose{} : rotation_about(timeline.hinge->centre, timeline.hinge->axis, angle);
        track.keys.push_back({frame, pose});
    };
    const std::vector<AngleKey>& angles = timeline.angles;
    for (std::size_t i = 0; i + 1 < angles.size(); ++i) {
        const AngleKey &a = angles[i], &b = angles[i + 1];
        const double turn = b.angle_rad - a.angle_rad;
        const int pieces = std::max(1, static_cast<int>(std::ceil(std::abs(turn) / largest_step)));
        for (int k = 0; k < pieces; ++k) {
            const double s = double(k) / pieces;
            add(a.frame + s * (b.frame - a.frame), a.angle_rad + s * turn);
        }
    }
    if (!angles.empty())
        add(angles.back().frame, angles.back().angle_rad);
    if (timeline.bone_tracks.size() <= bone)
        timeline.bone_tracks.resize(bone + 1);
    timeline.bone_tracks[bone] = std::move(track);
}

} // namespace fascicle::actions
