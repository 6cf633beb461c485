#pragma once
// A rival whose unknowns are the nodes of an embedding lattice; the surface hangs in it.

#include "solver/rivals/embedding_lattice.hpp"
#include "solver/rivals/rival_body.hpp"

namespace fascicle::solver {

class LatticeBody : public RivalBody {
public:
    /// spacing_mm: of the lattice's cubes.
    LatticeBody(const SoftBodyProblem& problem, double spacing_mm);
    std::size_t state_bytes() const override;
    /// Nodes follow from the positions: where these are the surface's own they stay, else they are where an elastic body is in
    /// equilibrium whose every vertex is pulled to its position. last_step is not used.
    bool set_state(const Points& positions, const Points& last_step) override;
    const EmbeddingLattice& lattice() const { return lattice_; }
    const Points& nodes() const { return nodes_; }

protected:
    /// Nodes go along with the solids as the surface's vertices do (carry_weights, brought to the nodes).
    void carry_nodes();
    /// Free vertices to where their tetrahedra have them.
    void skin();
    /// T: direction of the fibres, or zero.
    const std::vector<Vec3>& fibres() const { return fibres_; }
    /// V: a third of the area of a vertex's triangles at rest.
    const std::vector<double>& vertex_areas() const { return areas_; }
    /// N: 1 for nodes of parts without an attached vertex.
    std::vector<std::uint8_t> loose_nodes() const;

    EmbeddingLattice lattice_;
    Points nodes_;

private:
    std::vector<double> node_shares_; ///< N x solids, or empty
    std::vector<Vec3> fibres_;
    std::vector<double> areas_;
};

/// Where vertex `i` of an attached solid belongs now.
inline Vec3 attached_point(const SoftBodyProblem& problem, const std::vector<ContactSolid>& solids,
                           std::size_t i) {
    const auto body = static_cast<std::size_t>(problem.body_of_vertex[i]);
    return solids[body].now.apply(problem.surface->positions[i]);
}

} // namespace fascicle::solver
