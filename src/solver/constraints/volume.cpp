#include "solver/constraints/volume.hpp"

#include "fascicle/geometry/volume.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::solver {

VolumeConstraint::VolumeConstraint(const Points& rest, std::vector<Tri> triangles, double pressure, bool kept)
    : triangles_(std::move(triangles)), gradient_(rest.size(), Vec3::Zero()), kept_(kept) {
    rest_volume_ = evaluate(rest);
    wanted_ = pressure * rest_volume_;
}

double VolumeConstraint::evaluate(const Points& x) {
    volume_gradient(x, triangles_, gradient_);
    return signed_volume(x, triangles_);
}

void VolumeConstraint::project(Points& x, const std::vector<double>& inverse_mass, const Points& blocked) {
    if (!kept_)
        return;
    const double limit = max_step * std::abs(rest_volume_);
    const double error = std::clamp(evaluate(x) - wanted_, -limit, limit);
    if (!blocked.empty())
        for (std::size_t i = 0; i < x.size(); ++i) {
            // The correction goes along -error * gradient; against the normal when that product is negative.
            const double along = gradient_[i].dot(blocked[i]);
            if (-error * along < 0.0)
                gradient_[i] -= along * blocked[i];
        }
    double weight = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
        weight += inverse_mass[i] * gradient_[i].squaredNorm();
    if (!(weight > 0.0))
        return;
    const double multiplier = -error / weight;
    for (std::size_t i = 0; i < x.size(); ++i)
        x[i] += inverse_mass[i] * multiplier * gradient_[i];
}

} // namespace fascicle::solver
