#pragma once
// The part of the field that the attachments alone make. It is linear in the solids' poses, so what each vertex takes of each of them
// is found once: weights as in linear blend skinning, but four a solid, for its translation and the three coordinates it turns.

#include "fascicle/solver/soft_body_solver.hpp"
#include "solver/contact/solid_contact.hpp"
#include "solver/rivals/rbf/rbf_field.hpp"

#include <memory>

namespace fascicle::solver {

class RbfAttachments {
public:
    /// At most `most` attached vertices become centres, evenly spread, each place once. vertices: the free ones, F, whose places
    /// are asked for.
    RbfAttachments(const SoftBodyProblem& problem, std::vector<int> vertices, int most, RbfKernel kernel);

    /// Null when nothing is attached.
    const RbfField* field() const { return field_.get(); }
    /// F: where the field takes the free vertices, for the solids' poses now. Exact for a motion that all solids share. Needs a
    /// field().
    void place(std::span<const ContactSolid> solids, int threads, Points& places) const;
    std::size_t bytes() const;

private:
    Pose reference(std::span<const ContactSolid> solids) const;

    Points rest_; ///< F
    std::unique_ptr<RbfField> field_;
    std::vector<int> solid_of_centre_, attached_solids_;
    RbfMatrix
        weights_; ///< 4 A x F: of attached solid a, rows 4a (constant) to 4a + 3 (x, y, z about the polynomial's centre)
};

/// The rigid motion that takes `from` to `to` best, in the sense of least squares; where they leave a turn open, the nearest to
/// `like`. Both have at least one point.
Pose best_motion(const Points& from, const Points& to, const Pose& like);

} // namespace fascicle::solver
