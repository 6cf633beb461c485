#pragma once
// Smooth surfaces that a line muscle wraps over: the shortest way between two points outside of one.

#include "fascicle/base/types.hpp"

#include <vector>

namespace fascicle {

enum class WrapShape { sphere, cylinder, ellipsoid, torus };

/// In its own frame: sphere and ellipsoid about the origin, cylinder about z from -length / 2 to length / 2. One unit
/// throughout (metres in models of OpenSim). torus is known by name only: nothing wraps over it.
struct WrapSurface {
    WrapShape shape = WrapShape::sphere;
    double radius = 0;         ///< sphere, cylinder; > 0
    double length = 0;         ///< cylinder
    Vec3 radii = Vec3::Zero(); ///< ellipsoid; > 0
    int side_axis = 0;         ///< the constrained side ("quadrant"): x, y or z ...
    int side_sign = 0;         ///< ... at its positive (1) or negative (-1) half; 0: wrap on either side
};

enum class WrapOutcome {
    none,     ///< the straight line stays
    inside,   ///< an end lies inside of the surface: the straight line stays
    wrapped,  ///< wraps; another segment of the path may suit better
    mandatory ///< the straight line passes through the surface: this segment wraps
};

/// Where the path p -> first -> (over the surface) -> second -> q touches, and how long it is there.
struct WrapContact {
    WrapOutcome outcome = WrapOutcome::none;
    Vec3 first = Vec3::Zero(), second = Vec3::Zero();
    double surface_length = 0;
    bool wraps() const { return outcome == WrapOutcome::wrapped || outcome == WrapOutcome::mandatory; }
};

/// Wraps the line from p to q (the surface's frame). Rules of OpenSim for who wraps and on which side:
/// - an end inside: none. Sphere, ellipsoid: the segment must pass through. Cylinder without a constrained side: the same.
/// - cylinder with a constrained side: mandatory when the segment passes through and an end lies on that side; wraps, too,
///   when both ends lie on the other side, or when one does and the segment passes the axis there.
/// - without a constrained side, and on spheres when both ends lie on that side, the shorter way round.
/// - a cylinder that both tangent points lie beyond the ends of is passed by.
/// What comes out is the exact shortest path on that side: OpenSim lets the cylinder's tangent be off by one degree and
/// follows a plane section of the ellipsoid, so its ellipsoid paths are a little longer.
/// curve (may be null): points on the surface from first to second, both included; cleared otherwise.
/// Not finite, or a torus: none. No allocation but for the growth of `curve`.
///
/// Sphere of radius r (also the cylinder's section): |p - first| = sqrt(|p|^2 - r^2), the arc on a side spans the angle
/// between p and q on that side - acos(r / |p|) - acos(r / |q|). Cylinder: the unrolled path is straight, so the height
/// goes with the developed length. Ellipsoid: see ellipsoid_geodesic.
WrapContact wrap_segment(const WrapSurface& surface, const Vec3& p, const Vec3& q, std::vector<Vec3>* curve);

/// The three parts of wrap_segment. Arguments and result are the same.
WrapContact wrap_sphere(const WrapSurface& sphere, const Vec3& p, const Vec3& q, std::vector<Vec3>* curve);
WrapContact wrap_cylinder(const WrapSurface& cylinder, const Vec3& p, const Vec3& q,
                          std::vector<Vec3>* curve);
WrapContact wrap_ellipsoid(const WrapSurface& ellipsoid, const Vec3& p, const Vec3& q,
                           std::vector<Vec3>* curve);

} // namespace fascicle
