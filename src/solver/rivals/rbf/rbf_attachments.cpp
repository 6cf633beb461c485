#include "solver/rivals/rbf/rbf_attachments.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/base/bytes_of.hpp"
#include "fascicle/base/parallel.hpp"
#include "solver/rivals/best_rotation.hpp"
#include "solver/rivals/rbf/spread_points.hpp"

namespace fascicle::solver {

namespace {

std::vector<int> choose_centres(const SoftBodyProblem& problem, int most) {
    const Points& rest = problem.surface->positions;
    std::vector<int> attached, chosen;
    Eigen::AlignedBox3d box;
    for (std::size_t i = 0; i < rest.size(); ++i)
        if (problem.body_of_vertex[i] >= 0) {
            attached.push_back(static_cast<int>(i));
            box.extend(rest[i]);
        }
    if (!attached.empty())
        spread_points(rest, attached, static_cast<std::size_t>(most), 1e-9 * box.diagonal().norm(), chosen);
    return chosen;
}

} // namespace

Pose best_motion(const Points& from, const Points& to, const Pose& like) {
    FASCICLE_ASSERT(!from.empty() && from.size() == to.size());
    Vec3 a = Vec3::Zero(), b = Vec3::Zero();
    for (std::size_t i = 0; i < from.size(); ++i) {
        a += from[i] / double(from.size());
        b += to[i] / double(from.size());
    }
    Mat3 s = Mat3::Zero();
    double size = 0;
    for (std::size_t i = 0; i < from.size(); ++i) {
        s += (from[i] - a) * (to[i] - b).transpose();
        size += (from[i] - a).squaredNorm();
    }
    constexpr double tie = 1e-9;
    Pose result;
    result.rotation = best_rotation(s + (size > 0.0 ? tie * size : 1.0) * like.rotation.transpose());
    result.translation = b - result.rotation * a;
    return result;
}

RbfAttachments::RbfAttachments(const SoftBodyProblem& problem, std::vector<int> vertices, int most,
                               RbfKernel kernel) {
    for (const int v : vertices)
        rest_.push_back(problem.surface->positions[static_cast<std::size_t>(v)]);
    const std::vector<int> centres = choose_centres(problem, most);
    if (centres.empty())
        return;
    Points places;
    std::vector<int> row_of_solid(problem.solids.size(), -1);
    for (const int v : centres) {
        places.push_back(problem.surface->positions[static_cast<std::size_t>(v)]);
        const int body = problem.body_of_vertex[static_cast<std::size_t>(v)];
        solid_of_centre_.push_back(body);
        int& row = row_of_solid[static_cast<std::size_t>(body)];
        if (row < 0) {
            row = static_cast<int>(attached_solids_.size());
            attached_solids_.push_back(body);
        }
    }
    field_ = std::make_unique<RbfField>(std::move(places), kernel);
    if (attached_solids_.size() < 2)
        return; // moves as that solid does
    RbfMatrix right = RbfMatrix::Zero(field_->size(), 4 * static_cast<Eigen::Index>(attached_solids_.size()));
    for (std::size_t i = 0; i < centres.size(); ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        const int a = row_of_solid[static_cast<std::size_t>(solid_of_centre_[i])];
        right(row, 4 * a) = 1.0;
        right.block<1, 3>(row, 4 * a + 1) =
            (field_->centres()[i] - field_->polynomial().centre()).transpose();
    }
    evaluate(*field_, {}, field_->solve(right), rest_, problem.threads, weights_);
}

Pose RbfAttachments::reference(std::span<const ContactSolid> solids) const {
    const Pose first = solids[static_cast<std::size_t>(attached_solids_[0])].now;
    if (attached_solids_.size() < 2 || field_->polynomial().full())
        return first;
    Points moved;
    for (std::size_t i = 0; i < solid_of_centre_.size(); ++i)
        moved.push_back(
            solids[static_cast<std::size_t>(solid_of_centre_[i])].now.apply(field_->centres()[i]));
    return best_motion(field_->centres(), moved, first);
}

void RbfAttachments::place(std::span<const ContactSolid> solids, int threads, Points& places) const {
    FASCICLE_ASSERT(field_ != nullptr);
    const Pose motion = reference(solids);
    const Vec3 centre = field_->polynomial().centre();
    const auto count = static_cast<Eigen::Index>(weights_.rows());
    // What is left of the solids' motions beyond the common one, to be multiplied by the weights.
    Eigen::Matrix3Xd left(3, count);
    for (Eigen::Index a = 0; a < count / 4; ++a) {
        const Pose& pose =
            solids[static_cast<std::size_t>(attached_solids_[static_cast<std::size_t>(a)])].now;
        left.col(4 * a) = pose.apply(centre) - motion.apply(centre);
        left.middleCols<3>(4 * a + 1) = pose.rotation - motion.rotation;
    }
    places.resize(rest_.size());
    parallel_for(threads, rest_.size(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            places[i] = motion.apply(rest_[i]);
            if (count > 0)
                places[i] += left * weights_.col(static_cast<Eigen::Index>(i));
        }
    });
}

std::size_t RbfAttachments::bytes() const {
    return bytes_of(rest_, solid_of_centre_, attached_solids_) +
           static_cast<std::size_t>(weights_.size()) * sizeof(double) + (field_ ? field_->bytes() : 0);
}

} // namespace fascicle::solver
