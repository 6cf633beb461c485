#pragma once
// The distance constraints of a problem, one per edge of its surface: shared by the plain and the fast kernel.

#include "fascicle/geometry/mesh_topology.hpp"
#include "fascicle/solver/soft_body_solver.hpp"
#include "solver/compliance.hpp"
#include "solver/constraints/distance.hpp"

#include <cmath>
#include <vector>

namespace fascicle::solver {

/// rest: V rest positions. Edges of infinite compliance (stiffness 0, or running exactly along the fibres) are left out.
inline std::vector<DistanceConstraint>
make_edge_constraints(const SoftBodyProblem& problem, const Points& rest, const MeshTopology& topology) {
    const double stiffness = problem.parameters.get("solver.stiffness");
    std::vector<DistanceConstraint> constraints;
    for (std::size_t e = 0; e < topology.edges().size(); ++e) {
        const Edge& edge = topology.edges()[e];
        const double softness = problem.edge_softness.empty() ? 1.0 : problem.edge_softness[e];
        const double length =
            (rest[static_cast<std::size_t>(edge.a)] - rest[static_cast<std::size_t>(edge.b)]).norm();
        // W = 2 for two free points of unit mass. The spring constant 1 / alpha is what k multiplies.
        const double compliance = compliance_from_stiffness(stiffness, 2.0) / softness;
        if (std::isfinite(compliance))
            constraints.push_back({edge.a, edge.b, length, compliance});
    }
    return constraints;
}

} // namespace fascicle::solver
