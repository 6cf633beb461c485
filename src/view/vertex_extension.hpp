#pragma once
// How far the surface is stretched around each vertex, for colouring.

#include "fascicle/geometry/mesh_topology.hpp"

#include <vector>

namespace fascicle::view {

/// One value per vertex: the mean of length / rest length over the edges at the vertex. 1 unchanged, below 1 shortened.
/// Edges without rest length do not count; a vertex without edges that count has 1. points and rest: one per vertex of
/// the topology.
std::vector<double> vertex_extension(const MeshTopology& topology, const Points& rest, const Points& points);

} // namespace fascicle::view
