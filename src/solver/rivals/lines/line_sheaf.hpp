#pragma once
// The lines of a muscle: from one attachment to another, through via points fixed to solids, tight over the solids in between.

#include "solver/rivals/lines/muscle_line.hpp"

namespace fascicle::solver {

class LineSheaf {
public:
    /// make_lines(), pulled tight.
    LineSheaf(const SoftBodyProblem& problem, const MeshTopology& topology, const EndShares& shares,
              const ContactSettings& contact, int count, int via);

    const std::vector<MuscleLine>& lines() const { return lines_; }
    /// Lines for the solids' poses `now`: from where they were for those of the last call (rest, at first), in steps so small that no
    /// line jumps over a solid. A motion that all solids share moves them rigidly. Where the step's solids are too near for a via
    /// point, it is pushed out.
    void move(std::span<const ContactSolid> now, int threads);
    std::size_t bytes() const;

private:
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
