#pragma once
// The elastic energy that the constraints stand for, E = sum share C^2 / (2 alpha'), alpha' = alpha / h^2, term by
// term: for the forces, the curvature and the matrix of the coarse correction. Positions in scene units, E in scene units
// squared (unit masses, times h^2).

#include "fascicle/geometry/dihedral_angle.hpp"
#include "solver/compliance.hpp"
#include "solver/constraints/dihedral.hpp"
#include "solver/constraints/distance.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace fascicle::solver {

struct ElasticTerms {
    const std::vector<DistanceConstraint>* edges = nullptr;
    const std::vector<DihedralConstraint>* hinges = nullptr;
    double bending = 0;   ///< k of the hinges: their alpha is that of W = 1 times their own W at rest
    double substep_s = 0; ///< h
    double share = 1;     ///< of the energy that the coarse correction carries, see balance_of()
};

/// One constraint at some positions: C, up to four points with grad C, and share / alpha'.
struct ElasticTerm {
    int count = 0;
    std::array<int, 4> point{};
    std::array<Vec3, 4> gradient;
    double value = 0;
    double weight = 0;
};

/// Compliances below those of this stiffness count as it: a rigid constraint has no energy.
inline constexpr double stiffest_coarse = 0.99;

/// A hinge counts as thin from this multiple of its sum |grad|^2 at rest on.
inline constexpr double thin_hinge = 4.0;

/// How much softer than the energy one Gauss-Seidel sweep of the substep h acts, kappa = 1 + rho W / alpha' of the
/// stiffest edge, W = 2. A sweep that divides by max(W + alpha', kappa alpha') has all its constraints softer by the
/// same kappa, so it rests where the energy rests, whatever h; one that divides by W + alpha' makes soft constraints as
/// stiff as stiff ones. rho = 1 is the fastest such sweep. What is left is that a constraint sees what the ones before
/// it in the same sweep have done; rho = 4 makes that small, where the sweep can spare it (kappa <= 100). As h
/// goes to 0, kappa goes to 1 and the plain sweep comes back. The coarse correction carries the share 1 - 1 / kappa of
/// the energy, the sweep 1 / kappa.
inline double balance_of(const std::vector<DistanceConstraint>& edges, double substep_s) {
    double least = compliance_from_stiffness(stiffest_coarse, 2.0);
    if (!edges.empty()) {
        const auto softer = [](const auto& a, const auto& b) { return a.compliance < b.compliance; };
        least = std::max(least, std::min_element(edges.begin(), edges.end(), softer)->compliance);
    }
    const double fastest = 2.0 * substep_s * substep_s / least;
    return 1.0 + std::clamp(100.0 / fastest, 1.0, 4.0) * fastest;
}

/// A share of all terms: one in `stride`, chosen by a hash of the index, `phase` says which. Counting off would choose
/// by direction: the edges of a regular mesh come in turns.
struct TermSample {
    std::uint32_t phase = 0;
    std::uint32_t stride = 1;
    bool has(std::size_t index) const {
        return stride == 1 || ((static_cast<std::uint32_t>(index) * 2654435761U) >> 16) % stride == phase;
    }
};

/// The term of edge e.
inline void edge_term(const ElasticTerms& terms, const Points& x, std::size_t e, ElasticTerm& term) {
    const DistanceConstraint& c = (*terms.edges)[e];
    const DistanceValue d =
        distance_value(x[static_cast<std::size_t>(c.a)], x[static_cast<std::size_t>(c.b)], c.rest);
    term.count = 2;
    term.point = {c.a, c.b, 0, 0};
    term.gradient[0] = d.gradient_a;
    term.gradient[1] = -d.gradient_a;
    term.value = d.value;
    term.weight = terms.share * terms.substep_s * terms.substep_s /
                  std::max(c.compliance, compliance_from_stiffness(stiffest_coarse, 2.0));
}

/// The term of hinge k; false where it is degenerate. A hinge whose wings have become thin has large gradients W;
/// from four times its W at rest on its compliance grows with W, or its force would have no bound.
inline bool hinge_term(const ElasticTerms& terms, const Points& x, std::size_t k, ElasticTerm& term) {
    const DihedralConstraint& c = (*terms.hinges)[k];
    const auto value = hinge_value(c, x);
    if (!value)
        return false;
    double w = 0;
    for (std::size_t j = 0; j < 4; ++j)
        w += value->gradient[j].squaredNorm();
    const double unit = compliance_from_stiffness(std::min(terms.bending, stiffest_coarse), 1.0);
    term.count = 4;
    term.point = c.p;
    term.gradient = value->gradient;
    term.value = value->error_rad;
    term.weight =
        terms.share * terms.substep_s * terms.substep_s / std::max(c.compliance, unit * w / thin_hinge);
    return true;
}

/// f(term) for every edge in the sample.
template <class F>
void for_each_edge_term(const ElasticTerms& terms, const Points& x, TermSample sample, F f) {
    ElasticTerm term;
    for (std::size_t e = 0; e < terms.edges->size(); ++e)
        if (sample.has(e)) {
            edge_term(terms, x, e, term);
            f(term);
        }
}

/// f(term) for every hinge in the sample that is not degenerate.
template <class F>
void for_each_hinge_term(const ElasticTerms& terms, const Points& x, TermSample sample, F f) {
    ElasticTerm term;
    for (std::size_t k = 0; k < terms.hinges->size(); ++k)
        if (sample.has(k) && hinge_term(terms, x, k, term))
            f(term);
}

/// From there on, alpha' of a hinge is this times sum |grad|^2.
inline double thin_hinge_compliance(const ElasticTerms& terms) {
    return compliance_from_stiffness(std::min(terms.bending, stiffest_coarse), 1.0) /
           (thin_hinge * terms.substep_s * terms.substep_s);
}

} // namespace fascicle::solver
