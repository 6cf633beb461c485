#include "solver/coarse/cluster_basis.hpp"

#include "solver/coarse/cluster_seeds.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::solver {

namespace {

std::size_t at(int i) {
    return static_cast<std::size_t>(i);
}

} // namespace

ClusterBasis::ClusterBasis(const Points& rest, const MeshTopology& topology,
                           const std::vector<double>& inverse_mass, int wanted)
    : weights_(rest.size()) {
    const ClusterSeeds seeds = find_cluster_seeds(rest, topology, inverse_mass, wanted);
    clusters_ = static_cast<int>(seeds.vertices.size());
    if (clusters_ == 0)
        return;
    radius_ = seeds.radius > 0 ? seeds.radius : 1.0;
    for (std::size_t i = 0; i < rest.size(); ++i) {
        const auto& near = seeds.nearest[i];
        if (inverse_mass[i] == 0.0 || near.count == 0)
            continue;
        const double reach = near.count == 5 ? near.distance[4] : near.distance[at(near.count - 1)] + radius_;
        double sum = 0;
        std::array<double, 4> weight{};
        for (std::size_t k = 0; k < at(std::min(near.count, 4)); ++k) {
            const double share = reach > 0 ? 1.0 - near.distance[k] / reach : 1.0;
            weights_[i].cluster[k] = static_cast<std::uint16_t>(near.seed[k]);
            weight[k] = share * share;
            sum += share * share;
        }
        // A vertex as far from all of its seeds as from the fifth follows the nearest.
        if (!(sum > 0))
            weight[0] = sum = 1.0;
        const double ramp = std::min(1.0, seeds.from_fixed[i] / radius_);
        for (std::size_t k = 0; k < 4; ++k)
            weights_[i].weight[k] = static_cast<float>(weight[k] * ramp / sum);
    }
    band_ = order_clusters(topology, weights_, clusters_);
    for (const ClusterWeights& own : weights_)
        for (std::size_t k = 0; k < 4; ++k)
            for (std::size_t l = 0; l < 4; ++l)
                if (own.weight[k] > 0.0F && own.weight[l] > 0.0F && own.cluster[k] < own.cluster[l])
                    neighbours_.push_back({own.cluster[k], own.cluster[l]});
    std::sort(neighbours_.begin(), neighbours_.end());
    neighbours_.erase(std::unique(neighbours_.begin(), neighbours_.end()), neighbours_.end());
    neighbours_.shrink_to_fit();
    set_reference(rest);
}

void ClusterBasis::find_centres(const Points& x) {
    centre_.assign(at(clusters_), Vec3::Zero());
    total_.assign(at(clusters_), 0.0);
    for (std::size_t i = 0; i < x.size(); ++i)
        for (std::size_t k = 0; k < 4; ++k)
            if (const double w = weights_[i].weight[k]; w != 0.0) {
                centre_[at(weights_[i].cluster[k])] += w * x[i];
                total_[at(weights_[i].cluster[k])] += w;
            }
    for (std::size_t m = 0; m < centre_.size(); ++m)
        if (total_[m] > 0)
            centre_[m] /= total_[m];
}

void ClusterBasis::set_reference(const Points& x) {
    find_centres(x);
    reference_ = x;
    reference_centre_ = centre_;
    turn_.assign(at(clusters_), Eigen::Quaterniond::Identity());
}

void ClusterBasis::update_frames(const Points& x) {
    find_centres(x);
    moment_.assign(at(clusters_), Mat3::Zero());
    for (std::size_t i = 0; i < x.size(); ++i)
        for (std::size_t k = 0; k < 4; ++k)
            if (const double w = weights_[i].weight[k]; w != 0.0) {
                const std::size_t m = at(weights_[i].cluster[k]);
                moment_[m] += w * (x[i] - centre_[m]) * (reference_[i] - reference_centre_[m]).transpose();
            }
    for (std::size_t m = 0; m < turn_.size(); ++m)
        turn_to(m, moment_[m]);
}

double ClusterBasis::mean_bend() const {
    double sum = 0;
    for (const auto& [a, b] : neighbours_) {
        const double half = turn_[at(a)].dot(turn_[at(b)]); // cosine of half the angle
        sum += 4.0 * std::max(0.0, 1.0 - half * half);
    }
    return neighbours_.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(neighbours_.size()));
}

void ClusterBasis::set_frame(int cluster, const Vec3& c, const Vec3& first, const Mat3& moment) {
    const std::size_t m = at(cluster);
    // sum w (r - d) = 0, so the moment does not depend on c.
    if (total_[m] > 0)
        centre_[m] = c + first / total_[m];
    turn_to(m, moment);
}

/// Turns the cluster's frame towards the rotation nearest to the moment.
void ClusterBasis::turn_to(std::size_t cluster, const Mat3& moment) {
    Eigen::Quaterniond& q = turn_[cluster];
    for (int pass = 0; pass < 3; ++pass) {
        const Mat3 r = q.toRotationMatrix();
        Vec3 axis = Vec3::Zero();
        double along = 0;
        for (int c = 0; c < 3; ++c) {
            axis += r.col(c).cross(moment.col(c));
            along += r.col(c).dot(moment.col(c));
        }
        axis /= std::abs(along) + 1e-12 * moment.norm() + 1e-300;
        const double angle = axis.norm();
        if (!(angle > 1e-9) || !std::isfinite(angle))
            break;
        q = Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis / angle)) * q;
        q.normalize();
    }
}

void ClusterBasis::restrict_forces(const Points& x, const Points& f, std::span<float> out) {
    modes_.assign(2 * at(clusters_), Vec3::Zero());
    for (std::size_t i = 0; i < x.size(); ++i)
        for (std::size_t k = 0; k < 4; ++k)
            if (const double w = weights_[i].weight[k]; w != 0.0) {
                const std::size_t m = at(weights_[i].cluster[k]);
                const Vec3 force = w * f[i];
                modes_[2 * m] += force;
                modes_[2 * m + 1] += (x[i] - centre_[m]).cross(force);
            }
    for (std::size_t m = 0; m < at(clusters_); ++m) {
        const Mat3 back = turn_[m].toRotationMatrix().transpose();
        const Vec3 force = back * modes_[2 * m], torque = back * modes_[2 * m + 1] / radius_;
        for (int c = 0; c < 3; ++c) {
            out[6 * m + at(c)] = static_cast<float>(force[c]);
            out[6 * m + 3 + at(c)] = static_cast<float>(torque[c]);
        }
    }
}

void ClusterBasis::prolong(const Points& x, std::span<const float> q, Points& u) {
    modes_.resize(2 * at(clusters_));
    for (std::size_t m = 0; m < at(clusters_); ++m) {
        const Mat3 turn = turn_[m].toRotationMatrix();
        modes_[2 * m] = turn * Vec3(q[6 * m], q[6 * m + 1], q[6 * m + 2]);
        modes_[2 * m + 1] = turn * Vec3(q[6 * m + 3], q[6 * m + 4], q[6 * m + 5]) / radius_;
    }
    for (std::size_t i = 0; i < x.size(); ++i) {
        Vec3 sum = Vec3::Zero();
        for (std::size_t k = 0; k < 4; ++k)
            if (const double w = weights_[i].weight[k]; w != 0.0) {
                const std::size_t m = at(weights_[i].cluster[k]);
                sum += w * (modes_[2 * m] + modes_[2 * m + 1].cross(x[i] - centre_[m]));
            }
        u[i] = sum;
    }
}

} // namespace fascicle::solver
