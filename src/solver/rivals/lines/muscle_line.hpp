#pragma once
// The lines of a muscle at rest, before they are pulled tight.

#include "solver/rivals/lines/end_shares.hpp"
#include "solver/rivals/lines/taut_string.hpp"

namespace fascicle::solver {

/// Nodes of a line, first and last at its attachments.
inline constexpr std::size_t line_nodes = 41;

/// Vectors are of line_nodes each.
struct MuscleLine {
    int part = 0;                   ///< component of the surface that it runs through
    int from = 0, to = 0;           ///< solids of its ends
    Points nodes;                   ///< where they are now
    Points rest;                    ///< at rest
    std::vector<int> solid;         ///< that a node is fixed to, -1 none
    std::vector<std::uint8_t> held; ///< 1 where solid >= 0
    std::vector<double> clearance;  ///< the distance that a node keeps from the solids; empty: the contact's
};

/// Every part of the surface that is attached to two solids or more gets about `count` lines between its attachments
/// (pair_attachments()), with `via` points on each (0 to 8), along the middle of the muscle.
std::vector<MuscleLine> make_lines(const SoftBodyProblem& problem, const MeshTopology& topology,
                                   const EndShares& shares, int count, int via);

} // namespace fascicle::solver
