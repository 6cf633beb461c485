#pragma once
// A body-centred cubic lattice of tetrahedra that a closed surface is embedded in: no mesher is needed, and all tetrahedra have the
// same, good shape. Source: methods notes 6.4; the lattice: Labelle & Shewchuk 2007, "Isosurface stuffing", section 3 (there each
// tetrahedron has two edges of length a and four of a sqrt(3)/2, volume a^3/12, no angle below 60 degrees or above 90).

#include "fascicle/base/bytes_of.hpp"
#include "fascicle/geometry/tri_mesh.hpp"

#include <cstdint>

namespace fascicle::solver {

using Tet = std::array<int, 4>;

/// A point inside a tetrahedron: sum weights_i * node_i, weights >= 0 but for rounding, sum 1. tet -1: of no triangle, not bound.
struct TetBinding {
    int tet = -1;
    std::array<double, 4> weights{};
};

struct EmbeddingLattice {
    double spacing = 0;               ///< edge of the cubes, scene units
    Points nodes;                     ///< N, at rest
    std::vector<Tet> tets;            ///< T, positive volume
    std::vector<double> fill;         ///< T: share of each that lies in the solid, in [least_fill, 1]
    std::vector<TetBinding> bindings; ///< V, of the surface's vertices
    std::vector<int> neighbour_starts,
        neighbours; ///< N + 1; of each node those it shares a tetrahedron with, ascending

    /// Where the surface's vertex i is when the nodes are at x.
    Vec3 bound_point(std::size_t i, const Points& x) const;
    std::size_t bytes() const { return bytes_of(nodes, tets, fill, bindings, neighbour_starts, neighbours); }
};

struct LatticeOptions {
    double spacing = 5.0;  ///< wanted, scene units, > 0
    int most_tets = 60000; ///< at least 1000
    int threads = 1;
};

/// Tetrahedra that a triangle of the surface touches, and those inside (winding number of the solid > 0.5). The lattice is aligned with
/// the axes, starts at the box of the used vertices, and depends on nothing else. spacing: at most a sixth of the box's diagonal, so
/// that a small body still has a few; made coarser, by steps of 1.1, until there are at most most_tets. Nodes and tetrahedra are
/// numbered cell by cell, x fastest. Two parts of a surface that come nearer than the spacing share tetrahedra and stick together.
/// Partly filled tetrahedra weigh by their fill (20 samples), so that a thin sheet is as stiff as it is thick, not as its
/// lattice is; never below least_fill, so that no node is without stiffness.
/// The surface: closed, positions finite, some triangle with area (else an error).
EmbeddingLattice make_embedding_lattice(const TriMesh& surface, const LatticeOptions& options);

inline constexpr double least_fill = 0.05;

} // namespace fascicle::solver
