#pragma once
// What moves when: one keyed track per bone, and the joint angle that names the frames.

#include "fascicle/base/pose.hpp"

#include <optional>
#include <string>

namespace fascicle {

/// A joint axis: a point in scene units and a direction (any length but zero).
struct Hinge {
    Vec3 centre = Vec3::Zero();
    Vec3 axis = Vec3::UnitX();
};

/// Numbers of frames of the three phases of a there-and-back motion.
struct Phases {
    int out = 100;
    int back = 100;
    int rest = 100;
    int total() const { return out + back + rest; }
};

struct PoseKey {
    double frame = 0;
    Pose pose;
};

/// Keys in ascending order of frame. Between keys: screw motion; outside: the nearest key's pose; no keys: at
/// rest.
struct BoneTrack {
    std::vector<PoseKey> keys;
    Pose sample(double frame) const;
    bool moves() const;
};

struct AngleKey {
    double frame = 0;
    double angle_rad = 0;
};

/// Frame 0 is rest; frames 1 .. last_frame follow. A frame lasts `solver.frame_time`.
struct Timeline {
    int last_frame = 300;
    std::optional<Hinge> hinge;         ///< the joint that the angle belongs to, when there is one
    std::vector<AngleKey> angles;       ///< linear between keys; empty: 0 throughout
    std::vector<BoneTrack> bone_tracks; ///< one per bone of the scene, or fewer: the rest stays

    /// Pose of a bone from its rest pose to the (fractional) frame.
    Pose bone_pose(int bone, double frame) const;
    double angle_rad(double frame) const;
    /// Whether the bone has another pose in some frame than in another.
    bool moves(int bone) const {
        const auto b = static_cast<std::size_t>(bone);
        return b < bone_tracks.size() && bone_tracks[b].moves();
    }
};

/// Angle 0 -> angle_rad over phases.out frames, back over phases.back, then rest; the bones listed in
/// `moving` turn about the hinge with it. Keys are set densely enough that no screw step exceeds a quarter
/// turn. Error (usage) when a phase is negative, above a million, or all are 0.
Timeline make_hinge_timeline(const Hinge& hinge, double angle_rad, const Phases& phases, int bone_count,
                             const std::vector<int>& moving);

/// A bone is shifted by `shift` over phases.out frames, back over phases.back, then rests. No hinge, angle 0.
Timeline make_shift_timeline(const Vec3& shift, const Phases& phases, int bone_count, int moving);

} // namespace fascicle
