#pragma once
// Where the particles of a mass-spring body are: on its surface and on a lattice inside.
// Janak 2012 takes the points of k x k fibres; this layer knows no fibres, so the lattice lines stand in for them
// (docs/rivals/mass-spring.md).

#include "fascicle/geometry/mesh_topology.hpp"
#include "fascicle/geometry/solid_query.hpp"
#include "fascicle/geometry/tri_mesh.hpp"

#include <span>
#include <vector>

namespace fascicle::mass_spring {

/// rest: P points. vertex: P, the surface vertex that a boundary particle is, ascending, -1 for the inner ones that follow.
struct ParticleSet {
    Points rest;
    std::vector<int> vertex;
    Mat3 axes = Mat3::Identity(); ///< columns: lattice directions, the first along the lines; right-handed
    double spacing = 0;           ///< of the lattice, scene units; 0 when the surface has no extent

    std::size_t size() const { return rest.size(); }
};

/// Columns: line direction, then the surface's longer and shorter principal axis across it.
/// along (per edge, (u.v)^2 of edge direction u and fibres v): a constant v makes u^T (v v^T) u of it, so the line direction is the
/// first eigenvector of the symmetric S that minimises sum over edges l^2 (u^T S u - along)^2. Empty, or a fit without one
/// dominant direction: the longest principal axis of the surface's vertices.
Mat3 lattice_axes(const TriMesh& surface, const MeshTopology& topology, const std::vector<double>& along);

/// Spacing h for which inner nodes and boundary particles together are about `wanted`:
/// max(0, V - reach h A) / h^3 + 1.1 A / h^2, V and A volume and area, decreasing in h.
double spacing_for(double volume, double area, int wanted);

/// Boundary particles: vertices of some triangle, each farther than 0.8 h from those chosen before it. Vertices of different
/// bodies (body_of_vertex) need only 0.5 h between them, and the first of each body is always one, so that every
/// attachment holds something. Inner: lattice nodes at least inner_depth h deep. extra: vertices that have to be particles.
ParticleSet sample_particles(const TriMesh& surface, const MeshTopology& topology,
                             std::span<const int> body_of_vertex, const SolidQuery& solid, const Mat3& axes,
                             int wanted, std::span<const int> extra = {});

inline constexpr double inner_depth = 0.5;

} // namespace fascicle::mass_spring
