#pragma once
// Where the fibres run in an embedding lattice, from what a SoftBodyProblem says of them along its edges.

#include "fascicle/geometry/mesh_topology.hpp"
#include "fascicle/solver/soft_body_solver.hpp"
#include "solver/rivals/embedding_lattice.hpp"

namespace fascicle::solver {

/// Per edge c = (u . v)^2: SoftBodyProblem::edge_along; without it from edge_softness k = (1 - |u . v|)^a, c = (1 - k^(1/a))^2, a > 0 its
/// exponent (solver.anisotropy). Empty: neither is there.
std::vector<double> edge_squares(const SoftBodyProblem& problem, std::size_t edges);

/// V: at each vertex the symmetric matrix M (in the tangent plane: M n = 0) with the least sum of (u^T M u - c)^2 over its edges, u their
/// directions in that plane. With all edges exact M = t t^T, t the part of v in the plane. At least three edges in different directions
/// are needed; where they are not, a little regularisation (1e-6) makes M small. Vertices without triangles: zero.
std::vector<Mat3> vertex_fibre_matrices(const TriMesh& surface, const MeshTopology& topology,
                                        const std::vector<double>& squares);

/// T: unit direction of the fibres in each tetrahedron, zero where nobody says (all matrices zero). The matrices of the bound vertices
/// are spread into the lattice (nodes without any take the mean of their neighbours, layer by layer, then all are smoothed a few times)
/// and the main axis of the mean of a tetrahedron's four is taken. Sign: the largest component is positive.
std::vector<Vec3> lattice_fibres(const EmbeddingLattice& lattice, const std::vector<Mat3>& matrices);

} // namespace fascicle::solver
