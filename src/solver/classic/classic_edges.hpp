#pragma once
// Edge lengths: C = |p1 - p2| - d (Mueller et al. 2007; paper eq. 2), projected one edge after the other.

#include "fascicle/geometry/mesh_topology.hpp"
#include "fascicle/geometry/tri_mesh.hpp"
#include "solver/classic/classic_state.hpp"

namespace fascicle::classic {

/// One projection of the sweep. The factor multiplies the raw correction (paper eq. 5: k = 1 - |u.v|; 1
/// without fibres): no time step, no iteration count in it.
struct DirectedEdge {
    int from = -1;
    int to = -1;
    double rest_length = 0;
    double factor = 1;
};

/// The order of a sweep.
/// published: vertex by vertex, and at each vertex its edges in the order in which the triangles bring them;
/// every triangle (a, b, c) stores a->b, b->c, c->a, so an edge between two triangles is projected twice a
/// sweep, once from each end (notes 1.3). meant: every undirected edge once, ascending. softness: one factor
/// per topology edge, or empty for 1. stiffness: multiplies them all (the program has 1).
std::vector<DirectedEdge> edge_sweep(const TriMesh& mesh, const MeshTopology& topology,
                                     const std::vector<double>& softness, double stiffness, bool meant);

/// dp1 = -w1/(w1+w2) (|p1-p2| - d) factor n, dp2 = +w2/(w1+w2) (...) n, n = (p1-p2)/|p1-p2|.
/// Skipped when w1 + w2 < 1e-5 (as the program does) and, where the program would divide by zero, when the
/// edge has shrunk below 1e-9 of its rest length.
void project_edges(ClassicState& state, const std::vector<DirectedEdge>& sweep);

} // namespace fascicle::classic
