#pragma once
// A smooth field on a muscle's surface with given values on its attachments.

#include "fascicle/geometry/mesh_topology.hpp"
#include "fascicle/geometry/tri_mesh.hpp"

namespace fascicle {

/// Solves sum_j w_ij (u_i - u_j) = 0 on all vertices that are not fixed, for several fields at once (after
/// Dong, Kircher, Garland 2004). w_ij = (cot a_ij + cot b_ij) / 2 at rest; weights that are negative or not
/// finite are raised to a millionth of the mean, so that no vertex exceeds its neighbours (maximum
/// principle). fixed: V flags; values: V x C, row-major, read at fixed vertices; returns V x C with all
/// vertices filled. Values of vertices in a component without any fixed vertex, and of vertices without
/// triangles, are those passed in. Error (failed) when the system cannot be factorised.
std::vector<double> solve_harmonic(const TriMesh& mesh, const MeshTopology& topology,
                                   const std::vector<bool>& fixed, const std::vector<double>& values,
                                   int fields);

/// Gradient of a piecewise linear field per triangle (T), tangential, unit of the field per scene unit; zero
/// on a triangle without area.
Points triangle_gradients(const TriMesh& mesh, const std::vector<double>& field);

} // namespace fascicle
