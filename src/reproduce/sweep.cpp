#include "reproduce/sweep.hpp"

#include "fascicle/base/assert.hpp"

namespace fascicle::reproduce {

SweepTurn sweep_turn(MotionKind motion) {
    FASCICLE_ASSERT(is_sweep(motion));
    if (motion == MotionKind::adduction)
        return {Vec3(-0.0023238561, -0.9947301120, -0.1025017264), -4.7269250453, 40};
    return {Vec3(0.0738764645, -0.1023926792, 0.9919969794), -5.2898825715, 30};
}

Timeline through_rest(const Timeline& out, double other_rad) {
    FASCICLE_ASSERT(out.hinge.has_value());
    std::vector<int> moving;
    for (std::size_t b = 0; b < out.bone_tracks.size(); ++b)
        if (out.moves(static_cast<int>(b)))
            moving.push_back(static_cast<int>(b));
    const int third = out.last_frame / 3, bones = static_cast<int>(out.bone_tracks.size());
    Timeline result = make_hinge_timeline(*out.hinge, out.angle_rad(third), {third, third, 0}, bones, moving);
    const Timeline other = make_hinge_timeline(*out.hinge, other_rad, {third, 0, 0}, bones, moving);
    const double begin = result.last_frame;
    result.last_frame += other.last_frame;
    for (const AngleKey& key : other.angles)
        if (key.frame > 0) // at 0 both are at rest
            result.angles.push_back({begin + key.frame, key.angle_rad});
    for (std::size_t b = 0; b < result.bone_tracks.size(); ++b)
        for (const PoseKey& key : other.bone_tracks[b].keys)
            if (key.frame > 0)
                result.bone_tracks[b].keys.push_back({begin + key.frame, key.pose});
    return result;
}

} // namespace fascicle::reproduce
