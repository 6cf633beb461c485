#pragma once
// Poses of a bone as turns about the axes of joints, one after the other, and keys made of them.

#include "fascicle/motion/timeline.hpp"

namespace fascicle {

/// A turn by the right-hand rule about an axis that stands still: a point in scene units and a unit vector.
struct JointTurn {
    Vec3 centre = Vec3::Zero();
    Vec3 axis = Vec3::UnitX();
    double angle_rad = 0;
};

/// What carries the bone from rest to the frame: the turns, first to last. No turns: rest.
struct JointKey {
    double frame = 0;
    std::vector<JointTurn> turns;
};

/// Product of the turns, the first applied first; exactly the identity when every angle is 0.
Pose pose_of(const std::vector<JointTurn>& turns);

/// Whether the turns are about the same axes, one by one. Where one key has fewer, the others' angle is 0 there.
bool same_axes(const JointKey& a, const JointKey& b);

enum class KeyStep {
    good,
    ambiguous, ///< half a turn or more, and nothing says which way
    too_fast   ///< half a turn or more in one frame
};

/// Whether a screw motion between two keys is the one that is meant. The turn between them is taken to be below pi:
/// within 1e-3 of it the axis is ambiguous.
KeyStep check_step(const PoseKey& from, const PoseKey& to);

/// Appends `to` to a track that ends at `from` (`to` is later). About the same axes the angles decide: the step is cut into
/// equal parts, linear in the angles, of at most a quarter turn (sum over the turns), so any number of turns goes through.
/// Otherwise one screw motion, and a key of half a turn or more is ambiguous. Appends nothing unless good.
KeyStep append_joint_key(BoneTrack& track, const JointKey& from, const JointKey& to);

} // namespace fascicle
