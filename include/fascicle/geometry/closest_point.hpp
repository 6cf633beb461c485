#pragma once
// Closest points of segments and triangles to a point.

#include "fascicle/base/types.hpp"

namespace fascicle {

/// point = sum weights_i * corner_i; weights >= 0 and sum to 1. Units: scene units and their square.
struct TrianglePoint {
    Vec3 point = Vec3::Zero();
    Vec3 weights = Vec3(1, 0, 0);
    double squared_distance = 0;
};

/// The point of the triangle abc, border included, nearest to p. If p projects into the triangle it is the
/// foot of the perpendicular; otherwise it lies on an edge whose outer side p sees, so only those edges are
/// tried (a convex set's nearest point lies on a visible part of its border). A triangle without area
/// (|N|^2 <= 1e-24 l^4, N = (b-a) x (c-a), l the longest edge: signs would be noise) counts as its three
/// edges, and a point as itself.
TrianglePoint closest_point_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// Share t in [0, 1] of the nearest point a + t (b - a) of a segment; 0 for a segment without length.
double closest_share_on_segment(const Vec3& p, const Vec3& a, const Vec3& b);

} // namespace fascicle
