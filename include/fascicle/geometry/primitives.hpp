#pragma once
// Plain meshes made by formula.

#include "fascicle/geometry/tri_mesh.hpp"

#include <array>

namespace fascicle {

/// Box from lower to upper, each face a grid of quads (cells[0] along x and so on, each >= 1) cut into two
/// triangles: 4 (c0 c1 + c1 c2 + c2 c0) triangles, vertices shared between faces. Closed, outward,
/// deterministic order. Diagonals rise on the low x, low y and high z faces and fall on the others (seen in
/// the grid's own axes), as in the squeezed box of Cervenka & Kohout 2020, section 5.1.
TriMesh box_mesh(const Vec3& lower, const Vec3& upper, const std::array<int, 3>& cells);

/// Closed cylinder with flat ends: `around` (>= 3) sides, `along` (>= 1) rings of quads, each end a fan about its
/// centre. Side vertices lie on the cylinder, so the sides cut up to radius (1 - cos(pi / around)) inside it.
/// 2 around (along + 1) triangles. Outward; from != to, radius > 0.
TriMesh cylinder_mesh(const Vec3& from, const Vec3& to, double radius, int around, int along);

} // namespace fascicle
