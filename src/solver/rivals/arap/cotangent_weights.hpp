#pragma once
// Cotangent weights of a triangle surface, made positive, for energies that need them so.

#include "fascicle/geometry/mesh_topology.hpp"

namespace fascicle::solver {

/// No cotangent counts more than that of one degree, so that a needle does not outweigh all around it.
inline constexpr double most_cotangent = 57.289961630759424;
/// No weight is less: the half of a right angle's and one of 88.9 degrees. Keeps the surface connected where angles are obtuse.
inline constexpr double least_weight = 0.01;

/// cot of the angle at c in the triangle (a, b, c), in +-most_cotangent; 0 when c lies on a or b, where there is no angle. A
/// triangle without area has +-most_cotangent by the sign of the scalar product (0 or 180 degrees). Does not depend on the scale.
double bounded_cotangent(const Vec3& a, const Vec3& b, const Vec3& c);

/// E, per edge of the topology: w = (cot alpha + cot beta) / 2 over the angles opposite of it (Pinkall & Polthier 1993), at least
/// least_weight. At a border one angle counts, at a non-manifold edge all do. rest: V points.
std::vector<double> cotangent_weights(const Points& rest, const std::vector<Tri>& triangles,
                                      const MeshTopology& topology);

} // namespace fascicle::solver
