#pragma once
// A point that moves about a solid and is asked for again and again: what saves most of the winding numbers.

#include "fascicle/geometry/solid_query.hpp"

namespace fascicle {

/// Keeps the last place (in the solid's frame), its side, and the radius of a ball around it that lies on that
/// side (SolidSide). While the point stays in the ball of an outside place nothing is to do; when the balls of
/// the old and the new place overlap the side is the same and no winding number is needed. Both are true for
/// any two places, so that frames may come in any order.
struct TrackedPoint {
    Vec3 point = Vec3::Zero();
    double radius = -1; ///< < 0: nothing known yet
    int triangle = -1;  ///< nearest, a hint
    bool inside = false;

    /// Whether q is outside for sure, without looking.
    bool still_outside(const Vec3& q) const { return !inside && (q - point).norm() < radius; }

    /// Moves to q (finite): `inside` is then that of q. Returns the distance to the surface, at most `far`
    /// (finite, scene units), without a sign.
    double look(const SolidQuery& solid, const Vec3& q, double far);
};

} // namespace fascicle
