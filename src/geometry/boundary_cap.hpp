#pragma once
// Triangles that would close an open surface.

#include "fascicle/geometry/tri_mesh.hpp"

namespace fascicle {

/// Fans over the unbalanced edges of a surface: together with the surface every directed edge occurs as often
/// as its opposite, so that the winding number of both is an integer off the surface. Vertices at exactly the
/// same position count as one. Each connected set of unbalanced edges gets its own apex, the mean of its
/// vertices. No triangles when the surface is balanced already. Works on any triangle list: holes, cracks,
/// three triangles at an edge, inconsistent orientation.
TriMesh boundary_cap(const Points& points, const std::vector<Tri>& triangles);

/// For each vertex the lowest vertex at exactly the same position.
std::vector<int> coincident_vertices(const Points& points);

} // namespace fascicle
