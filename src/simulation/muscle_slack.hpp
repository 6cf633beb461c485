#pragma once
// How much the bones bring a muscle's ends together: the length of its middle line, carried by the bones alone.

#include "fascicle/simulation/prepare.hpp"

namespace fascicle {

/// The middle line runs through the centres of the muscle's cross-sections, taken at even levels of a harmonic field between
/// its attachments. Each point goes with the bones by the mean of that field's shares there, as a blend of screw motions
/// (Kavan, Collins, Zara, O'Sullivan 2008, "Geometric skinning with approximate dual quaternion blending"): half-way between two bones of a
/// joint it turns by half the angle and keeps its distance from the axis. So it stays out at the joint, as the muscle does, and its
/// length tells what fibres would have to do that neither stretch nor hang loose. Knows bones' motion, not the muscle's shape in it.
class MuscleSlack {
public:
    /// Nothing to tell (length() is 1) without attachments on two bones.
    MuscleSlack(const Scene& scene, const PreparedMuscle& muscle);

    /// Length of the middle line at these poses (B, from rest) over that at rest.
    double length(std::span<const Pose> poses) const;

private:
    struct Level {
        Vec3 centre = Vec3::Zero();
        std::vector<double> shares; ///< B
    };
    std::vector<Level> levels_;
    double rest_length_ = 0;
};

/// The pose that blends B poses by their shares (not negative, sum 1).
Pose blended_pose(std::span<const Pose> poses, std::span<const double> shares);

} // namespace fascicle
