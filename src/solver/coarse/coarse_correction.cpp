#include "solver/coarse/coarse_correction.hpp"

#include "solver/constraints/volume.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::solver {

namespace {

/// One in so many edges and hinges measures the curvature along a step, other ones each time.
constexpr std::uint32_t curvature_stride = 4;
/// By how much the matrix exceeds the curvature at the shape it is made for, so that it still does when it is older.
constexpr double safety = 1.5;
/// A step that had to be shortened to this, or clusters that have turned by this, ask for a new matrix.
constexpr double short_step = 0.4;
constexpr double far_turn_rad = 0.2;
/// Substeps that a matrix is kept at least.
constexpr int least_age = 3;

std::size_t at(int i) {
    return static_cast<std::size_t>(i);
}

double dot(const std::vector<float>& a, const std::vector<float>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += double(a[i]) * double(b[i]);
    return sum;
}

} // namespace

CoarseCorrection::CoarseCorrection(const Points& rest, const MeshTopology& topology,
                                   const std::vector<double>& inverse_mass, int clusters)
    : basis_(rest, topology, inverse_mass, clusters), force_(rest.size()), gradient_(rest.size()),
      u_(rest.size(), Vec3::Zero()) {
    for (auto* values : {&q_, &r_, &qg_, &g_})
        values->resize(at(basis_.unknowns()));
}

void CoarseCorrection::add(const Points& x, const ElasticTerm& term, double weight) {
    // Row of P^T grad C: the clusters of its points, ascending, with six entries each. In the frames of the moment when
    // the matrix is made nothing is turned.
    std::array<int, 16> cluster{};
    std::array<std::array<float, 6>, 16> row;
    int count = 0;
    const double scale = std::sqrt(weight);
    for (int j = 0; j < term.count; ++j) {
        const ClusterWeights& own = basis_.weights()[at(term.point[at(j)])];
        const Vec3& g = term.gradient[at(j)];
        for (std::size_t k = 0; k < 4; ++k) {
            if (own.weight[k] == 0.0)
                continue;
            const int m = own.cluster[k];
            int place = 0;
            while (place < count && cluster[at(place)] != m)
                ++place;
            if (place == count) {
                cluster[at(count)] = m;
                row[at(count)].fill(0.0F);
                ++count;
            }
            const double w = scale * own.weight[k];
            const Vec3 force = w * g;
            const Vec3 torque = (x[at(term.point[at(j)])] - basis_.centre(m)).cross(force) / basis_.radius();
            for (int c = 0; c < 3; ++c) {
                row[at(place)][at(c)] += static_cast<float>(force[c]);
                row[at(place)][at(c) + 3] += static_cast<float>(torque[c]);
            }
        }
    }
    for (int a = 0; a < count; ++a)
        for (int b = 0; b < count; ++b) {
            if (cluster[at(a)] < cluster[at(b)])
                continue;
            for (int j = 0; j < 6; ++j) {
                const int first = a == b ? j : 0;
                float* const to = &matrix_.at(6 * cluster[at(a)] + first, 6 * cluster[at(b)] + j);
                for (int i = first; i < 6; ++i)
                    to[i - first] += row[at(a)][at(i)] * row[at(b)][at(j)];
            }
        }
}

void CoarseCorrection::assemble(const Points& x, const ElasticTerms& terms,
                                const std::vector<double>& inverse_mass, const Points& normals) {
    basis_.set_reference(x);
    matrix_.reset(basis_.unknowns(), std::min(basis_.band(), basis_.unknowns() - 1));
    const auto add_term = [&](const ElasticTerm& term) { add(x, term, safety * term.weight); };
    for_each_edge_term(terms, x, {}, add_term);
    for_each_hinge_term(terms, x, {}, add_term);
    // Inertia, and contacts as stiff as an edge.
    const double contact =
        2.0 * terms.share * terms.substep_s * terms.substep_s / compliance_from_stiffness(0.9, 2.0);
    ElasticTerm one;
    one.count = 1;
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (inverse_mass[i] == 0.0)
            continue;
        one.point[0] = static_cast<int>(i);
        for (int c = 0; c < 3; ++c) {
            one.gradient[0] = Vec3::Unit(c);
            add(x, one, 1.0);
        }
        if (!normals.empty() && !normals[i].isZero(0.0)) {
            one.gradient[0] = normals[i];
            add(x, one, contact);
        }
    }
    for (int i = 0; i < basis_.unknowns(); ++i)
        matrix_.at(i, i) += 1e-6F * matrix_.at(i, i) + 1e-6F;
    matrix_.factor();
    age_ = 0;
    stale_ = false;
    ++assemblies_;
}

double CoarseCorrection::curvature(const Points& x, const ElasticTerms& terms) const {
    double sum = 0;
    const auto along = [&](const ElasticTerm& term) {
        double s = 0;
        for (int j = 0; j < term.count; ++j)
            s += term.gradient[at(j)].dot(u_[at(term.point[at(j)])]);
        sum += term.weight * s * s;
    };
    const TermSample sample{static_cast<std::uint32_t>(steps_ % curvature_stride), curvature_stride};
    for_each_edge_term(terms, x, sample, along);
    for_each_hinge_term(terms, x, sample, along);
    sum *= double(curvature_stride);
    for (const Vec3& u : u_)
        sum += u.squaredNorm();
    return sum;
}

void CoarseCorrection::correct(Points& x, const ElasticTerms& terms, VolumeConstraint& volume,
                               const std::vector<double>& inverse_mass, const Points& normals) {
    if (empty() || !(terms.share > 0.0))
        return;
    if (assemblies_ == 0 || stale_ || basis_.update_frames(x) > far_turn_rad)
        assemble(x, terms, inverse_mass, normals);
    ++age_;
    ++steps_;

    std::fill(force_.begin(), force_.end(), Vec3::Zero());
    const auto push = [&](const ElasticTerm& term) {
        for (int j = 0; j < term.count; ++j)
            force_[at(term.point[at(j)])] -= term.weight * term.value * term.gradient[at(j)];
    };
    for_each_edge_term(terms, x, {}, push);
    for_each_hinge_term(terms, x, {}, push);
    const double volume_error = volume.evaluate(x) - volume.wanted_volume();
    for (std::size_t i = 0; i < x.size(); ++i) {
        gradient_[i] = inverse_mass[i] * volume.gradient()[i];
        force_[i] += pressure_ * gradient_[i];
        if (!normals.empty()) {
            force_[i] -= std::min(0.0, force_[i].dot(normals[i])) * normals[i];
            gradient_[i] -= gradient_[i].dot(normals[i]) * normals[i];
        }
    }
    basis_.restrict_forces(x, force_, r_);
    basis_.restrict_forces(x, gradient_, g_);
    q_ = r_;
    qg_ = g_;
    matrix_.solve(q_, qg_);
    const double gain = dot(g_, qg_);
    const double more = gain > 0.0 ? (-volume_error - dot(g_, q_)) / gain : 0.0;
    for (std::size_t i = 0; i < q_.size(); ++i)
        q_[i] += static_cast<float>(more) * qg_[i];
    basis_.prolong(x, q_, u_);
    const double slope = dot(r_, q_) + more * dot(g_, q_);
    const double bend = curvature(x, terms);
    // Not more than 1, though the matrix is large: where inertia rules, it would be too far.
    const double step = bend > 0.0 ? std::clamp(slope / bend, 0.0, 1.0) : 0.0;
    stale_ = age_ >= least_age && step < short_step && bend > 0.0;
    if (!std::isfinite(step) || !std::isfinite(more)) { // a broken shape: left to the sweep
        stale_ = true;
        pressure_ = 0;
        return;
    }
    pressure_ += more;
    for (std::size_t i = 0; i < x.size(); ++i) {
        u_[i] *= step;
        x[i] += u_[i];
    }
}

} // namespace fascicle::solver
