#pragma once
// Shortest paths round an ellipsoid between two points outside of it.

#include "fascicle/base/types.hpp"

#include <vector>

namespace fascicle {

/// p -> first, straight and tangent; first -> second on the surface; second -> q, straight and tangent.
struct EllipsoidPath {
    Vec3 first = Vec3::Zero(), second = Vec3::Zero();
    double surface_length = 0;
    /// A geodesic, tangents matched to 1e-9 of the mean radius. False: the iteration did not end there, and the path is the
    /// section of the surface by a plane through p and q that it started from: a little longer. So it is where a constrained
    /// side has no geodesic: every string would slip off it.
    bool geodesic = false;
};

/// side_sign 0: the shortest path of all. 1 or -1: where the surface point nearest to the chord's middle lies on the other
/// half (sign of coordinate side_axis), the search starts at the section through the mirrored point and must stay there.
/// radii > 0, none above a million times another, about the origin; p, q on the surface or outside, and the segment between
/// them passes through the surface: the caller checks. curve (may be null): cleared, then points from first to second, both included.
///
/// The surface is F = sum x_i^2 / a_i^2 - 1 = 0. A geodesic has x'' = -(x'^T H x' / |grad F|^2) grad F, H the second
/// derivatives of F. In y = x / a it is a unit sphere: the tangent points from P = p / a are
///   y = P / |P|^2 + k c,  k = sqrt(1 - 1 / |P|^2),  c any unit vector at a right angle to P,
/// and leave p along a (c - k P), also when p lies on the surface. So a path is told by the angle of c and its length on the
/// surface, and is right when the line on from its end passes through q: two equations, solved by Newton's method from the
/// best of the plane sections, which are circles in y.
EllipsoidPath ellipsoid_geodesic(const Vec3& radii, const Vec3& p, const Vec3& q, int side_axis,
                                 int side_sign, std::vector<Vec3>* curve);

/// The point of the ellipsoid's surface nearest to p, which may lie anywhere; one of them where there are several. Error of
/// 1e-12 of the largest radius.
Vec3 closest_on_ellipsoid(const Vec3& radii, const Vec3& p);

} // namespace fascicle
