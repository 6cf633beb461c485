#pragma once
// How soft each edge is against stretching because of the fibres that pass it: k = 1 - |u . v|.
// Source: Cervenka & Kohout 2020, eq. 5, with the absolute value that is meant (fibres have no direction).

#include "fascicle/geometry/mesh_topology.hpp"
#include "fascicle/geometry/tri_mesh.hpp"

namespace fascicle {

/// Smallest k: an edge along the fibres keeps a little stiffness, so that the surface stays connected.
inline constexpr double min_edge_softness = 0.02;

/// Unit tangents of the nearest fibre at the mid-point of each edge (E), interpolated between the tangents at
/// the two ends of the nearest segment. Zero for every edge when there is no segment of some length.
Points edge_tangents_from_fibres(const TriMesh& mesh, const MeshTopology& topology, const Polylines& fibres);

/// Unit tangents (E) along the gradient of a field on the surface, the mean over the triangles at the edge;
/// zero where the field is flat (on an attachment).
Points edge_tangents_from_field(const TriMesh& mesh, const MeshTopology& topology,
                                const std::vector<double>& field);

/// k = max(min_edge_softness, (1 - |u . v|)^a) per edge, u the edge's direction at rest, v its tangent, a >=
/// 0 the parameter solver.anisotropy (0: 1 everywhere). 1 where v is zero or the edge has no length.
std::vector<double> edge_softness(const TriMesh& mesh, const MeshTopology& topology, const Points& tangents,
                                  double exponent);

} // namespace fascicle
