#pragma once
// A rigid placement x -> R x + t, and the screw motion between two of them.

#include "fascicle/base/types.hpp"

namespace fascicle {

/// rotation: proper 3x3 rotation; translation in scene units.
struct Pose {
    Mat3 rotation = Mat3::Identity();
    Vec3 translation = Vec3::Zero();

    Vec3 apply(const Vec3& x) const { return rotation * x + translation; }
    Vec3 apply_inverse(const Vec3& x) const { return rotation.transpose() * (x - translation); }
    Pose inverse() const { return {rotation.transpose(), -(rotation.transpose() * translation)}; }
    /// First `other`, then this.
    Pose after(const Pose& other) const {
        return {rotation * other.rotation, rotation * other.translation + translation};
    }
    bool is_identity() const { return rotation == Mat3::Identity() && translation == Vec3::Zero(); }
};

/// Can v be an axis: is its length a number that a double holds with all its digits, about 1.5e-154 to 1.3e154? Not so for
/// zero, infinity and NaN, nor where the squares leave the range of normal numbers.
bool has_direction(const Vec3& v);

/// Turn by `angle_rad` (right-hand rule) about the line through `centre` along `axis` (need not be a unit
/// vector, must have a direction).
Pose rotation_about(const Vec3& centre, const Vec3& axis, double angle_rad);

/// The pose at share s in [0, 1] of the screw motion from `from` to `to`: exp(s log(to from^-1)) from.
/// Exact at both ends; a pure translation for equal rotations. The turn must be below pi: at pi the axis is
/// ambiguous and one of the two is taken.
Pose screw_between(const Pose& from, const Pose& to, double s);

} // namespace fascicle
