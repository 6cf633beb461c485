#pragma once
// A string pulled tight over solids: the shortest path near to where it is.

#include "solver/contact/solid_contact.hpp"

#include <cstdint>

namespace fascicle::solver {

/// What a string's nodes must keep to, one of each per node.
struct StringHolds {
    std::span<const std::uint8_t> held; ///< 1 for a node that stays where it is; first and last always do
    /// Distance that a node keeps from the solids in place of ContactSettings::offset; empty: that.
    std::span<const double> clearance;
};

struct StringSettings {
    double tolerance =
        0; ///< it is tight when no node is farther than this from where its neighbours and the solids want it
    int most_sweeps = 400;
};

/// Moves the nodes that are not held to the shortest way that does not enter the solids: of all polylines near to this one that with the
/// least sum of squared segments, sum |q_k+1 - q_k|^2, whose segments between two held nodes are then equally long. Projected successive
/// over-relaxation: each node goes to the middle of its neighbours, by a factor beyond it, and out of the solids along the gradient of their grids (resolve_contact()). Between nodes a segment cuts at most
/// l^2 / (8 R) into a surface of radius R. Nothing moves when the string is tight already.
/// before: the nodes at the start of the step, as many, for what is too deep inside. Sweeps done.
int tighten(Points& nodes, const StringHolds& holds, const Points& before,
            std::span<const ContactSolid> solids, const ContactSettings& contact,
            const StringSettings& settings);

/// Sum of the segments.
double length_of(const Points& nodes);

} // namespace fascicle::solver
