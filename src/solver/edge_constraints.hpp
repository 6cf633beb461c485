#pragma once
// What the plain and the fast kernel both make of a problem: distance constraints, one per edge of its surface, and who can move.

#include "fascicle/geometry/mesh_topology.hpp"
#include "fascicle/solver/soft_body_solver.hpp"
#include "solver/compliance.hpp"
#include "solver/constraints/distance.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace fascicle::solver {

/// rest: V rest positions. Edges of infinite compliance (stiffness 0, or running exactly along the fibres) are left out.
inline std::vector<DistanceConstraint>
make_edge_constraints(const SoftBodyProblem& problem, const Points& rest, const MeshTopology& topology) {
    const double stiffness = problem.parameters.get("solver.stiffness");
    std::vector<DistanceConstraint> constraints;
    constraints.reserve(topology.edges().size());
    for (std::size_t e = 0; e < topology.edges().size(); ++e) {
        const Edge& edge = topology.edges()[e];
        const double softness = problem.edge_softness.empty() ? 1.0 : problem.edge_softness[e];
        const double length =
            (rest[static_cast<std::size_t>(edge.a)] - rest[static_cast<std::size_t>(edge.b)]).norm();
        // W = 2 for two free points of unit mass. The spring constant 1 / alpha is what k multiplies.
        const double compliance = compliance_from_stiffness(stiffness, 2.0) / softness;
        if (std::isfinite(compliance))
            constraints.push_back({edge.a, edge.b, length, compliance,
                                   problem.edge_along.empty() ? 0.0 : problem.edge_along[e]});
    }
    return constraints;
}

/// V: 1, or 0 for vertices fixed to a solid and for those of no triangle, which nothing holds and which stay where they are.
inline std::vector<double> inverse_masses(const SoftBodyProblem& problem, const MeshTopology& topology) {
    std::vector<double> masses(problem.body_of_vertex.size(), 1.0);
    for (std::size_t i = 0; i < masses.size(); ++i)
        if (problem.body_of_vertex[i] >= 0 || topology.vertex_component(static_cast<int>(i)) < 0)
            masses[i] = 0.0;
    return masses;
}

/// Clusters wanted for the coarse step. None for a body that nothing holds: it has no long waves that lag behind, and the
/// rounding of the coarse step would push it along.
inline int coarse_clusters(const SoftBodyProblem& problem, const std::vector<double>& masses) {
    const bool held = std::find(masses.begin(), masses.end(), 0.0) != masses.end();
    return held ? problem.parameters.get_int("solver.coarse") : 0;
}

} // namespace fascicle::solver
