#pragma once
// Values of the surface's vertices brought to the nodes of its lattice.

#include "solver/rivals/embedding_lattice.hpp"

namespace fascicle::solver {

/// values: V x width, row-major; counts: V, vertices with 0 are passed over. Result: N x width. A node of a tetrahedron with bound
/// vertices has their mean, weighted barycentrically; the others take the mean of the neighbours that have one, layer by layer
/// from the surface inwards; then `smoothing` times every node takes the mean of itself and its neighbours' mean. Nodes that
/// no counted vertex reaches: 0. A constant stays that constant (to rounding).
std::vector<double> node_values(const EmbeddingLattice& lattice, const std::vector<double>& values,
                                std::size_t width, const std::vector<double>& counts, int smoothing);

/// N: number of the part of the lattice that a node belongs to; parts hang together by tetrahedra.
std::vector<int> lattice_parts(const EmbeddingLattice& lattice);

} // namespace fascicle::solver
