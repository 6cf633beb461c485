#pragma once
// The lines of a muscle: from one attachment to another, through via points fixed to solids, tight over the solids in between.

#include "solver/rivals/lines/end_shares.hpp"
#include "solver/rivals/lines/taut_string.hpp"

namespace fascicle::solver {

/// Nodes of a line, first and last at its attachments.
inline constexpr std::size_t line_nodes = 41;

struct MuscleLine {
    int part = 0;                   ///< component of the surface that it runs through
    int from = 0, to = 0;           ///< solids of its ends
    Points nodes;                   ///< line_nodes, where they are now
    Points rest;                    ///< line_nodes, at rest
    std::vector<double> clearance;  ///< line_nodes: the distance that each keeps from the solids
    std::vector<int> solid;         ///< line_nodes: the solid that a node is fixed to, -1 none
    std::vector<std::uint8_t> held; ///< line_nodes: 1 where solid >= 0
};

class LineSheaf {
public:
    /// Every part of the surface that is attached to two solids or more gets about `count` lines between its attachments
    /// (pair_attachments()), with `via` points on each (0 to 8).
    LineSheaf(const SoftBodyProblem& problem, const MeshTopology& topology, const EndShares& shares,
              const ContactSettings& contact, int count, int via);

    const std::vector<MuscleLine>& lines() const { return lines_; }
    /// Lines for the solids' poses `now`: from where they were for those of the last call (rest, at first), in steps so small that no
    /// line jumps over a solid. A motion that all solids share moves them rigidly. Where the step's solids are too near for a via
    /// point, it is pushed out.
    void move(std::span<const ContactSolid> now, int threads);
    std::size_t bytes() const;

private:
    void add_lines(const SoftBodyProblem& problem, const MeshTopology& topology, const EndShares& shares,
                   int part, int count, int via);
    void find_clearance(MuscleLine& line) const;
    void step(std::span<const ContactSolid> solids, int threads);
    int steps_for(std::span<const ContactSolid> now) const;

    ContactSettings contact_; ///< without friction
    double longest_step_;     ///< scene units
    std::vector<MuscleLine> lines_;
    std::vector<Pose> poses_; ///< of the last call
    std::vector<ContactSolid> step_;
};

} // namespace fascicle::solver
