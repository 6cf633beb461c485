#include "solver/rivals/rbf/rbf_solver.hpp"

#include "fascicle/base/parallel.hpp"
#include "solver/contact/swept_clamp.hpp"
#include "solver/rivals/arap/arap_system.hpp"
#include "solver/rivals/arap/cotangent_weights.hpp"
#include "solver/rivals/rbf/rbf_attachments.hpp"
#include "solver/rivals/rbf/rbf_contact.hpp"
#include "solver/rivals/rbf/spread_points.hpp"
#include "solver/rivals/rival_body.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fascicle::solver {

namespace {

/// Centres are added so often: those of the first round push others in.
constexpr int contact_rounds = 2;
/// A vertex that lacks less of the contact offset than this share is left to the contact step.
constexpr double slack_share = 0.05;
/// Steps of a body that nothing holds out of solids; a cap goes half of its depth in each.
constexpr int push_rounds = 6;
/// Volume and contact take turns at most so often, until the volume is right to this share.
constexpr int settling_rounds = 16;
constexpr double enough_volume = 1e-5;
/// Of a body that nothing holds: keeps the membrane's system definite; forces of a closed surface's volume have no sum, so it hardly acts.
constexpr double anchor = 1e-4;

class RbfSolver final : public RivalBody {
public:
    explicit RbfSolver(const SoftBodyProblem& problem);
    bool uses_threads() const override { return true; }
    /// Displacements are taken from rest, so positions are all there is to take over.
    bool set_state(const Points& positions, const Points&) override {
        x() = positions;
        for (std::size_t k = 0; k < vertices_.size(); ++k)
            places_[k] = positions[static_cast<std::size_t>(vertices_[k])];
        return true;
    }
    std::size_t state_bytes() const override {
        return RivalBody::state_bytes() + attachments_.bytes() + contact_field_.bytes() + volume_.bytes() +
               bytes_of(normals_, vertices_, rest_, base_, places_, targets_, depth_, chosen_);
    }

private:
    void deform(double seconds) override;
    void carry_ways();
    void push_base();
    void find_targets();
    bool choose_centres(std::size_t most);
    void bend();
    void settle();
    void press_off();

    VolumeConstraint volume_;
    Points normals_, force_, give_,
        scratch_; ///< V: of contacts while settling; pressure's forces, and how the membrane gives way
    ArapCells cells_;
    std::unique_ptr<ArapSystem> membrane_;
    std::vector<int> vertices_; ///< the free ones, F
    Points rest_;               ///< F
    RbfAttachments attachments_;
    RbfContact contact_field_;
    int most_contacts_;
    Points base_; ///< F: by the attachments alone, or the rest shape moved rigidly
    /// F: where the ways to the wanted places begin: the last pass's places, before the volume was made right, carried by the solids.
    Points from_;
    Points places_, targets_;   ///< F: with the contacts so far; where contact wants them
    std::vector<double> depth_; ///< F: way to the target, 0 none
    std::vector<int> chosen_;   ///< contact centres of this pass, in F
    Points wanted_;             ///< of those
};

std::vector<int> indices_of_free(const std::vector<double>& inverse_mass) {
    std::vector<int> result;
    for (std::size_t i = 0; i < inverse_mass.size(); ++i)
        if (inverse_mass[i] != 0.0)
            result.push_back(static_cast<int>(i));
    return result;
}

RbfKernel kernel_of(const SoftBodyProblem& problem) {
    return problem.parameters.get_choice("rbf.kernel") == "cubic" ? RbfKernel::cubic : RbfKernel::linear;
}

RbfSolver::RbfSolver(const SoftBodyProblem& problem)
    : RivalBody(problem), volume_(rest(), problem.surface->triangles, param("solver.pressure"),
                                  problem.parameters.get_choice("solver.volume") == "kept"),
      normals_(rest().size(), Vec3::Zero()),
      cells_(rest(), topology(), cotangent_weights(rest(), problem.surface->triangles, topology())),
      vertices_(indices_of_free(inverse_mass())),
      attachments_(problem, vertices_, problem.parameters.get_int("rbf.centres"), kernel_of(problem)),
      most_contacts_(problem.parameters.get_int("rbf.contacts")), depth_(vertices_.size(), 0.0) {
    for (const int v : vertices_)
        rest_.push_back(rest()[static_cast<std::size_t>(v)]);
    if (attachments_.field() != nullptr)
        contact_field_ = RbfContact(*attachments_.field(), rest_, most_contacts_);
    targets_ = places_ = rest_;
    if (volume_.kept()) {
        const std::vector<std::uint8_t> free = free_vertices(inverse_mass());
        membrane_ =
            std::make_unique<ArapSystem>(cells_, free, anchor_penalties(cells_, topology(), free, anchor));
    }
}

void RbfSolver::deform(double) {
    if (vertices_.empty())
        return;
    carry_ways();
    if (attachments_.field() != nullptr)
        attachments_.place(solids(), problem().threads, base_);
    else { // nothing says where the body is but itself
        const Pose motion = best_motion(rest_, from_, Pose{});
        base_ = rest_;
        for (Vec3& p : base_)
            p = motion.apply(p);
        push_base();
    }
    places_ = base_;
    chosen_.clear();
    wanted_.clear();
    for (int round = 1; round <= contact_rounds && !solids().empty() && most_contacts_ > 0; ++round) {
        find_targets();
        if (!choose_centres(
                static_cast<std::size_t>((most_contacts_ * round + contact_rounds - 1) / contact_rounds)))
            break;
        bend();
    }
    if (!solids().empty()) { // what is still inside stops on its way, too
        find_targets();
        for (std::size_t k = 0; k < places_.size(); ++k)
            if (depth_[k] > 0.0)
                places_[k] = targets_[k];
    }
    for (std::size_t k = 0; k < vertices_.size(); ++k)
        x()[static_cast<std::size_t>(vertices_[k])] = places_[k];
    settle();
}

/// Every pass starts from the field, which may be far from the wanted volume, so volume and contact take turns: what contact takes away
/// is made up for elsewhere. The volume changes as that of a membrane under pressure does, x += p L^-1 grad V with L the cotangent
/// Laplacian and attached vertices held, which is smooth; grad V itself is as uneven as the sizes of triangles are.
void RbfSolver::settle() {
    std::fill(normals_.begin(), normals_.end(), Vec3::Zero());
    double last = std::numeric_limits<double>::infinity();
    for (int round = 0; round < settling_rounds && volume_.kept(); ++round) {
        const double off = volume_.evaluate(x()) - volume_.wanted_volume();
        if (std::abs(off) <= enough_volume * std::abs(volume_.rest_volume()))
            return;
        if (std::abs(off) >= last) { // between solids that leave no room there is nothing to gain
            x() = scratch_;
            return;
        }
        last = std::abs(off);
        const double side = off > 0.0 ? -1.0 : 1.0; // the way along grad V
        const auto block = [&](Points& vectors) {   // nothing goes against a bone
            for (std::size_t i = 0; i < vectors.size(); ++i)
                if (const double along = vectors[i].dot(normals_[i]); side * along < 0.0)
                    vectors[i] -= along * normals_[i];
        };
        force_ = volume_.gradient();
        block(force_);
        scratch_ = x();
        membrane_->solve(force_, force_, scratch_, give_); // of which the first is not needed
        scratch_ = x();
        block(give_);
        double slope = 0;
        for (std::size_t i = 0; i < give_.size(); ++i)
            slope += volume_.gradient()[i].dot(give_[i]);
        if (!(slope > 0.0))
            return;
        const double limit = VolumeConstraint::max_step * std::abs(volume_.rest_volume());
        const double pressure = std::clamp(off, -limit, limit) / slope;
        for (std::size_t i = 0; i < give_.size(); ++i)
            x()[i] -= pressure * give_[i];
        if (!solids().empty())
            press_off();
    }
}

void RbfSolver::press_off() {
    parallel_for(problem().threads, vertices_.size(), 512, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            const auto v = static_cast<std::size_t>(vertices_[k]);
            const ContactResult result = resolve_contact(x()[v], before()[v], solids(), contact());
            if (result.touched)
                normals_[v] = result.normal;
        }
    });
}

/// As free vertices are carried in every method.
void RbfSolver::carry_ways() {
    from_ = places_;
    const std::vector<double>& weights = problem().carry_weights;
    for (std::size_t k = 0; k < from_.size() && !weights.empty(); ++k) {
        Vec3 shift = Vec3::Zero();
        for (std::size_t b = 0; b < solids().size(); ++b)
            if (const double w = weights[static_cast<std::size_t>(vertices_[k]) * solids().size() + b];
                w != 0.0)
                shift +=
                    w * (solids()[b].now.apply(solids()[b].before.apply_inverse(places_[k])) - places_[k]);
        from_[k] += shift;
    }
}

/// Solids on one side push the whole body; those on two sides, against each other, leave it where it is.
void RbfSolver::push_base() {
    for (int round = 0; round < push_rounds && !solids().empty(); ++round) {
        places_ = base_;
        find_targets();
        Vec3 push = Vec3::Zero();
        int pushed = 0;
        for (std::size_t k = 0; k < base_.size(); ++k)
            if (depth_[k] > 0.0) {
                push += targets_[k] - base_[k];
                ++pushed;
            }
        if (pushed == 0)
            return;
        for (Vec3& p : base_)
            p += push / pushed;
    }
}

/// Of each vertex that the field would put too near to a solid: where its way there, straight from where it is carried, meets the solid.
/// Not the nearest place outside, which may be on any side: the surface would let a bone through as a sheet does a nail.
void RbfSolver::find_targets() {
    parallel_for(problem().threads, vertices_.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            depth_[k] = 0.0;
            if (nearest_solid(places_[k], solids()).value >= (1.0 - slack_share) * contact().offset)
                continue;
            double share = 1.0;
            for (const ContactSolid& solid : solids())
                share = std::min(share, free_share(*solid.grid, solid.now.apply_inverse(from_[k]),
                                                   solid.now.apply_inverse(places_[k]), contact().least,
                                                   contact().offset, solid.slope));
            targets_[k] = from_[k] + share * (places_[k] - from_[k]);
            const Vec3& before_it = before()[static_cast<std::size_t>(vertices_[k])];
            const ContactResult result = resolve_contact(targets_[k], before_it, solids(), contact());
            if (!result.outside || nearest_solid(targets_[k], solids()).value < contact().least)
                clamp_motion(targets_[k], before_it, solids(), contact());
            depth_[k] = (targets_[k] - places_[k]).norm();
        }
    });
}

/// Of those, evenly spread ones become centres, the deepest first. Whether any did.
bool RbfSolver::choose_centres(std::size_t most) {
    std::vector<int> candidates;
    for (std::size_t k = 0; k < depth_.size(); ++k)
        if (depth_[k] > 0.0)
            candidates.push_back(static_cast<int>(k));
    std::stable_sort(candidates.begin(), candidates.end(), [&](int a, int b) {
        return depth_[static_cast<std::size_t>(a)] > depth_[static_cast<std::size_t>(b)];
    });
    const std::size_t had = chosen_.size();
    const double size = attachments_.field() != nullptr ? attachments_.field()->polynomial().scale()
                                                        : RbfPolynomial(rest_).scale();
    spread_points(rest_, candidates, most, 1e-6 * size, chosen_);
    for (std::size_t k = had; k < chosen_.size(); ++k)
        wanted_.push_back(targets_[static_cast<std::size_t>(chosen_[k])]);
    return chosen_.size() > had;
}

/// The field through all centres so far.
void RbfSolver::bend() {
    RbfMatrix wanted(static_cast<Eigen::Index>(chosen_.size()), 3), coefficients, values;
    for (std::size_t k = 0; k < chosen_.size(); ++k)
        wanted.row(static_cast<Eigen::Index>(k)) =
            (wanted_[k] - base_[static_cast<std::size_t>(chosen_[k])]).transpose();
    Points centres;
    for (const int k : chosen_)
        centres.push_back(rest_[static_cast<std::size_t>(k)]);
    if (attachments_.field() != nullptr) {
        if (!contact_field_.solve(chosen_, wanted, coefficients))
            return;
        evaluate(*attachments_.field(), centres, coefficients, rest_, problem().threads, values);
    } else {
        // No affine part: to put a cap on a plane is an affine map, which would flatten the whole body.
        const RbfField field(centres, RbfKernel::linear, false);
        RbfMatrix right = RbfMatrix::Zero(field.size(), 3);
        right.topRows(wanted.rows()) = wanted;
        evaluate(field, {}, field.solve(right), rest_, problem().threads, values);
    }
    for (std::size_t k = 0; k < places_.size(); ++k)
        places_[k] = base_[k] + values.col(static_cast<Eigen::Index>(k));
}

} // namespace

std::unique_ptr<SoftBodySolver> make_rbf_solver(const SoftBodyProblem& problem) {
    return std::make_unique<RbfSolver>(problem);
}

} // namespace fascicle::solver
