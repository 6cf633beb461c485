#pragma once
// Where every vertex and constraint of a problem lies in the fast kernel's arrays. Depends on the mesh and the attachments alone, never on
// the number of threads, so that results do not either.

#include "fascicle/geometry/mesh_topology.hpp"
#include "fascicle/solver/soft_body_solver.hpp"
#include "solver/fast/layout.hpp"

#include <optional>
#include <vector>

namespace fascicle::solver::fast {

/// Constraints that one thread sweeps alone: those inside a block, or those across the border to the next one.
struct ConstraintSet {
    std::size_t first_record = 0; ///< indices count from here
    std::size_t first_edge = 0, edges = 0;
    std::size_t first_hinge = 0, hinges = 0;
};

struct GroupRange {
    std::size_t begin = 0, end = 0; ///< vertex groups
};

struct Plan {
    Vec3 origin = Vec3::Zero(); ///< all records are relative to this point
    std::vector<int> record_of_vertex;
    Points rest; ///< V rest positions as the records hold them: relative, rounded to float
    std::vector<float> inverse_mass; ///< by record
    std::size_t groups = 0;
    std::vector<GroupRange> chunks; ///< sums are formed over these
    std::vector<ConstraintSet> interiors, interfaces;
    std::vector<EdgePacket> edges;
    std::vector<ActivePacket> active; ///< by edge packet; empty when the edges know no fibres
    std::vector<HingePacket> hinges;
    std::vector<std::uint16_t> rings;
    std::vector<std::uint32_t> ring_base, ring_first, ring_length; ///< by group
    float relax = 1;                                               ///< kappa
    std::size_t padding = 0; ///< lanes of constraint packets without a constraint

    std::size_t records() const { return packet * groups; }
};

/// Nothing when the mesh does not suit the fast kernel: vertices so entangled that no order brings neighbours within reach of
/// 16-bit indices, with more than a thousand neighbours, or open ones where parts of the surface meet in a point.
/// kappa: how much softer sweeps act next to a coarse step, see balance_of(); 1 without.
std::optional<Plan> make_plan(const SoftBodyProblem& problem, const MeshTopology& topology,
                              double kappa = 1.0);

} // namespace fascicle::solver::fast
