#include "fascicle/motion/joint_track.hpp"

#include "fascicle/base/assert.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace fascicle {

namespace {

constexpr double half_turn = std::numbers::pi;
constexpr double near_half_turn = half_turn - 1e-3;

bool same_axis(const JointTurn& a, const JointTurn& b) {
    return (a.centre - b.centre).norm() <= 1e-9 * (1.0 + a.centre.norm()) && (a.axis - b.axis).norm() <= 1e-9;
}

double angle_of(const JointKey& key, std::size_t turn) {
    return turn < key.turns.size() ? key.turns[turn].angle_rad : 0.0;
}

double sum_of_angles(const JointKey& key) {
    double sum = 0;
    for (const JointTurn& turn : key.turns)
        sum += std::abs(turn.angle_rad);
    return sum;
}

} // namespace

Pose pose_of(const std::vector<JointTurn>& turns) {
    Pose pose;
    for (const JointTurn& turn : turns)
        if (turn.angle_rad != 0.0)
            pose = rotation_about(turn.centre, turn.axis, turn.angle_rad).after(pose);
    return pose;
}

bool same_axes(const JointKey& a, const JointKey& b) {
    const std::size_t both = std::min(a.turns.size(), b.turns.size());
    return std::equal(a.turns.begin(), a.turns.begin() + static_cast<std::ptrdiff_t>(both), b.turns.begin(),
                      same_axis);
}

KeyStep check_step(const PoseKey& from, const PoseKey& to) {
    const Mat3 step = to.pose.rotation * from.pose.rotation.transpose();
    const double turn = Eigen::AngleAxisd(step).angle(); // from 0 to pi
    if (turn >= near_half_turn)
        return KeyStep::ambiguous;
    return turn < half_turn * (to.frame - from.frame) ? KeyStep::good : KeyStep::too_fast;
}

KeyStep append_joint_key(BoneTrack& track, const JointKey& from, const JointKey& to) {
    FASCICLE_ASSERT(!track.keys.empty() && track.keys.back().frame == from.frame && to.frame > from.frame);
    if (!same_axes(from, to)) {
        const PoseKey key{to.frame, pose_of(to.turns)};
        if (sum_of_angles(from) >= half_turn || sum_of_angles(to) >= half_turn)
            return KeyStep::ambiguous;
        const KeyStep check = check_step(track.keys.back(), key);
        if (check == KeyStep::good)
            track.keys.push_back(key);
        return check;
    }
    JointKey part = from.turns.size() > to.turns.size() ? from : to; // its axes
    double turn = 0;
    for (std::size_t i = 0; i < part.turns.size(); ++i)
        turn += std::abs(angle_of(to, i) - angle_of(from, i));
    if (turn >= half_turn * (to.frame - from.frame))
        return KeyStep::too_fast;
    // No more than a quarter turn for each screw, and a bit for rounding.
    const int steps = std::max(1, static_cast<int>(std::ceil(turn / (0.5 * half_turn) - 1e-9)));
    for (int k = 1; k <= steps; ++k) {
        const double s = double(k) / steps;
        for (std::size_t i = 0; i < part.turns.size(); ++i)
            part.turns[i].angle_rad =
                k == steps ? angle_of(to, i) : angle_of(from, i) + s * (angle_of(to, i) - angle_of(from, i));
        track.keys.push_back(
            {k == steps ? to.frame : from.frame + s * (to.frame - from.frame), pose_of(part.turns)});
    }
    return KeyStep::good;
}

} // namespace fascicle
