#pragma once
// Whether a triangle and a tetrahedron have a point in common, by separating axes.

#include "fascicle/base/types.hpp"

namespace fascicle::solver {

/// Corners of a tetrahedron with det(x1 - x0, x2 - x0, x3 - x0) > 0.
using TetCorners = std::array<Vec3, 4>;

/// Separating axis test (Gottschalk, Lin, Manocha 1996, "OBBTree"; two convex polytopes are apart if and only if a face normal of
/// one of them or a cross product of an edge of each parts them). Touching counts as meeting: axes part only by more than 1e-12 of
/// the tetrahedron's size. A triangle without area counts as the segment or point that it is.
bool triangle_meets_tet(const std::array<Vec3, 3>& triangle, const TetCorners& tet);

/// Barycentric coordinates of p, summing to 1: p = sum w_i x_i. All >= 0 inside. tet: not flat.
std::array<double, 4> tet_weights(const Vec3& p, const TetCorners& tet);

} // namespace fascicle::solver
