#pragma once
// How much of each solid a vertex is: harmonic on the surface between the attachments, 1 at a solid's own, 0 at the others'.

#include "fascicle/geometry/mesh_topology.hpp"
#include "fascicle/solver/soft_body_solver.hpp"

namespace fascicle::solver {

struct EndShares {
    std::vector<int> solids; ///< those that anything is attached to, ascending; S
    std::vector<double>
        values; ///< V x S, row-major, in [0, 1]; rows sum to 1, or to 0 where a part of the surface has no attachment
    double of(std::size_t vertex, std::size_t solid) const { return values[vertex * solids.size() + solid]; }
    std::size_t bytes() const { return bytes_of(solids, values); }
};

/// Laplace's equation with edge weights 1 / length (never negative, so the shares never leave [0, 1], whatever the triangles are like).
/// Edges shorter than 1e-6 of the mean count as that long.
EndShares end_shares(const SoftBodyProblem& problem, const MeshTopology& topology);

} // namespace fascicle::solver
