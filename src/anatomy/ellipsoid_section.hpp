#pragma once
// Paths round an ellipsoid in a plane: where the search for a geodesic starts.

#include "anatomy/wrap_round.hpp"

namespace fascicle {

/// Plane through P and Q in y = x / a, where the ellipsoid is the unit sphere and every section a circle.
class EllipsoidSections {
public:
    /// p, q as in ellipsoid_geodesic.
    EllipsoidSections(const Vec3& radii, const Vec3& p, const Vec3& q);

    /// The path that turns counter-clockwise about the plane's normal, which is turned about the chord by `angle`, rad. All
    /// angles from 0 to 2 pi: every plane, both ways round.
    struct Section {
        Vec3 normal, centre, axis_x, axis_y; ///< of the circle, in y
        double radius;
        CircleRoute route;
    };
    Section section(double angle_rad) const;
    /// Angle whose section passes through the surface point x.
    double angle_through(const Vec3& x) const;

    /// Point of the arc, share in [0, 1], in x.
    Vec3 point(const Section& section, double share) const;
    /// Of the arc, in x: a sum of chords, an estimate from below to a thousandth.
    double arc_length(const Section& section) const;
    /// Of the whole path from p to q.
    double length(const Section& section) const;

    /// Of all angles that of the shortest path, to a hundredth of a radian: the search goes on from there.
    double shortest_angle() const;

private:
    Vec3 radii_, p_, q_; ///< in x
    Vec3 from_, to_;     ///< in y
    Vec3 across_, up_;   ///< unit vectors at right angles to the chord and each other
};

} // namespace fascicle
