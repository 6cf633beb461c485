#include "solver/constraints/distance.hpp"

#include "fascicle/solver/active_strain.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::solver {

DistanceValue distance_value(const Vec3& xa, const Vec3& xb, double rest) {
    const Vec3 d = xa - xb;
    const double length = d.norm();
    if (!(length > 1e-9 * rest) || length == 0.0)
        return {length - rest, Vec3::Zero()};
    return {length - rest, d / length};
}

void DistanceConstraints::add(const DistanceConstraint& constraint) {
    if (std::isfinite(constraint.compliance))
        items_.push_back(constraint);
}

void DistanceConstraints::set_active_length(double share) {
    if (rest_.empty())
        for (const DistanceConstraint& c : items_)
            rest_.push_back(c.rest);
    for (std::size_t i = 0; i < items_.size(); ++i)
        items_[i].rest = rest_[i] * active_edge_scale(items_[i].along, share);
}

void DistanceConstraints::project(Points& x, const std::vector<double>& inverse_mass, double substep_s,
                                  double kappa) const {
    const double per_h2 = 1.0 / (substep_s * substep_s);
    for (const DistanceConstraint& c : items_) {
        const auto a = static_cast<std::size_t>(c.a), b = static_cast<std::size_t>(c.b);
        const double weight = inverse_mass[a] + inverse_mass[b];
        if (weight == 0.0)
            continue;
        const DistanceValue d = distance_value(x[a], x[b], c.rest);
        const double softness = c.compliance * per_h2;
        const double multiplier = -d.value / std::max(weight + softness, kappa * softness);
        x[a] += inverse_mass[a] * multiplier * d.gradient_a;
        x[b] -= inverse_mass[b] * multiplier * d.gradient_a;
    }
}

} // namespace fascicle::solver
