#pragma once
// Points on a surface between its vertices: where a bone can come through while every vertex is outside of it.

#include "fascicle/geometry/mesh_topology.hpp"

namespace fascicle {

/// The means of the triangles' corners, T points in the order of the triangles. centroids is not reallocated
/// when it has that size already. A non-finite corner makes its centroid non-finite.
void face_centroids(const Points& points, const std::vector<Tri>& triangles, Points& centroids);

/// The middles of the edges, E points in the order of the edges; as above.
void edge_midpoints(const Points& points, const std::vector<Edge>& edges, Points& midpoints);

} // namespace fascicle
