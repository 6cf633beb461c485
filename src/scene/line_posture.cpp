#include "fascicle/scene/line_posture.hpp"

#include "fascicle/scene/line_muscles.hpp"

#include <Eigen/Cholesky>
#include <cmath>

namespace fascicle {

namespace {

/// Residuals, metres: where points of each body are in the frame of the first one, against where they should be.
class PostureError {
public:
    PostureError(const Skeleton& skeleton, const std::vector<char>& used, const std::vector<Points>& points,
                 const std::vector<Pose>& rest)
        : skeleton_(skeleton) {
        for (std::size_t b = 0; b < used.size(); ++b) {
            if (used[b] == 0)
                continue;
            if (bodies_.empty())
                base_ = b;
            bodies_.push_back(b);
            Vec3 middle = Vec3::Zero();
            for (const Vec3& p : points[b])
                middle += p / static_cast<double>(points[b].size());
            for (const Vec3& p : {middle, Vec3(middle + 0.1 * Vec3::UnitX()),
                                  Vec3(middle + 0.1 * Vec3::UnitY()), Vec3(middle + 0.1 * Vec3::UnitZ())}) {
                probes_.push_back(p);
                wanted_.push_back(rest[base_].apply_inverse(rest[b].apply(p)));
            }
        }
    }

    Eigen::VectorXd at(const Eigen::VectorXd& q) {
        set_posture(skeleton_, {q.data(), static_cast<std::size_t>(q.size())}, posture_);
        Eigen::VectorXd r(static_cast<Eigen::Index>(3 * probes_.size()));
        for (std::size_t i = 0; i < probes_.size(); ++i)
            r.segment<3>(static_cast<Eigen::Index>(3 * i)) =
                posture_.poses[base_].apply_inverse(posture_.poses[bodies_[i / 4]].apply(probes_[i])) -
                wanted_[i];
        return r;
    }

private:
    const Skeleton& skeleton_;
    std::size_t base_ = 0;
    std::vector<std::size_t> bodies_;
    Points probes_, wanted_;
    Posture posture_;
};

} // namespace

void fit_posture(const Skeleton& skeleton, const std::vector<char>& used, const std::vector<Points>& points,
                 const std::vector<Pose>& rest, std::vector<double>& values) {
    PostureError error(skeleton, used, points, rest);
    const auto n = static_cast<Eigen::Index>(values.size());
    Eigen::VectorXd q = Eigen::Map<const Eigen::VectorXd>(values.data(), n);
    Eigen::VectorXd r = error.at(q);
    double damping = 1e-8; // against squared levers of about 0.1 m
    constexpr double step = 1e-6;
    for (int round = 0; round < 100 && damping < 1e3 && r.norm() > 1e-12; ++round) {
        Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(r.size(), n);
        for (Eigen::Index c = 0; c < n; ++c) {
            if (skeleton.coordinates[static_cast<std::size_t>(c)].locked)
                continue;
            Eigen::VectorXd up = q, down = q;
            up[c] += step;
            down[c] -= step;
            slopes.col(c) = (error.at(up) - error.at(down)) / (2 * step);
        }
        Eigen::MatrixXd normal = slopes.transpose() * slopes;
        normal.diagonal().array() += damping;
        const Eigen::VectorXd next = q - normal.ldlt().solve(slopes.transpose() * r);
        const Eigen::VectorXd there = error.at(next);
        if (there.norm() < r.norm()) {
            const bool settled = (next - q).norm() < 1e-10;
            q = next;
            r = there;
            damping = std::max(damping * 0.1, 1e-10);
            if (settled)
                break;
        } else {
            damping *= 10;
        }
    }
    values.assign(q.data(), q.data() + n);
    apply_couplers(skeleton, values);
}

} // namespace fascicle
