#include "solver/coarse/coarse_correction.hpp"

#include "solver/coarse/coarse_step.hpp"
#include "solver/constraints/volume.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::solver {

namespace {

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
                                   const std::vector<double>& inverse_mass, int clusters, int substeps)
    : matrix_(rest, topology, inverse_mass, clusters, substeps), force_(rest.size()), gradient_(rest.size()),
      u_(rest.size(), Vec3::Zero()) {
    for (auto* values : {&q_, &r_, &qg_, &g_})
        values->resize(at(matrix_.basis().unknowns()));
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
    ClusterBasis& basis = matrix_.basis();
    if (assemblies_ > 0)
        basis.update_frames(x);
    if (assemblies_ == 0 || stale_ || matrix_.outdated()) {
        matrix_.assemble(x, terms, inverse_mass, normals);
        age_ = 0;
        stale_ = false;
        ++assemblies_;
    }
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
    basis.restrict_forces(x, force_, r_);
    basis.restrict_forces(x, gradient_, g_);
    q_ = r_;
    qg_ = g_;
    matrix_.solve(q_);
    matrix_.solve(qg_);
    const double gain = dot(g_, qg_);
    const double more = gain > 0.0 && volume.kept() ? (-volume_error - dot(g_, q_)) / gain : 0.0;
    for (std::size_t i = 0; i < q_.size(); ++i)
        q_[i] += static_cast<float>(more) * qg_[i];
    basis.prolong(x, q_, u_);
    const double slope = dot(r_, q_) + more * dot(g_, q_);
    const double bend = curvature(x, terms);
    const double step = bend > 0.0 ? std::clamp(slope / bend, 0.0, longest_step) : 0.0;
    stale_ = age_ >= least_matrix_age && step < short_step && bend > 0.0;
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
