#include "solver/constraints/dihedral.hpp"

#include "fascicle/geometry/dihedral_angle.hpp"
#include "solver/compliance.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::solver {

namespace {

const Vec3& at(const Points& x, int i) {
    return x[static_cast<std::size_t>(i)];
}

/// A wing so thin that its angle jumps with the least movement: |N|^2 < 1e-4 l^4, height below a hundredth of
/// the edge.
bool sliver(const Vec3& p0, const Vec3& p1, const Vec3& p2, const Vec3& p3) {
    const double l2 = (p3 - p2).squaredNorm();
    const double limit = 1e-4 * l2 * l2;
    return (p2 - p0).cross(p3 - p0).squaredNorm() < limit || (p3 - p1).cross(p2 - p1).squaredNorm() < limit;
}

} // namespace

DihedralConstraints::DihedralConstraints(const Points& rest, const std::vector<Dihedral>& dihedrals,
                                         double stiffness) {
    if (stiffness <= 0.0)
        return;
    items_.reserve(dihedrals.size());
    for (const Dihedral& pair : dihedrals) {
        const Vec3 &p0 = at(rest, pair.p0), &p1 = at(rest, pair.p1), &p2 = at(rest, pair.p2),
                   &p3 = at(rest, pair.p3);
        const auto angle = dihedral_angle_with_gradient(p0, p1, p2, p3);
        if (!angle || sliver(p0, p1, p2, p3))
            continue;
        double weight = 0;
        for (const Vec3& g : angle->gradient)
            weight += g.squaredNorm();
        items_.push_back({{pair.p0, pair.p1, pair.p2, pair.p3},
                          angle->angle_rad,
                          compliance_from_stiffness(stiffness, weight)});
    }
}

std::optional<HingeValue> hinge_value(const DihedralConstraint& hinge, const Points& x) {
    const Vec3 &p0 = at(x, hinge.p[0]), &p1 = at(x, hinge.p[1]), &p2 = at(x, hinge.p[2]),
               &p3 = at(x, hinge.p[3]);
    const auto angle = dihedral_angle_with_gradient(p0, p1, p2, p3);
    if (!angle || sliver(p0, p1, p2, p3))
        return std::nullopt;
    const double error = wrap_angle(angle->angle_rad - hinge.rest_rad);
    return HingeValue{std::clamp(error, -max_correction_rad, max_correction_rad), angle->gradient};
}

std::size_t DihedralConstraints::project(Points& x, const std::vector<double>& inverse_mass, double substep_s,
                                         double kappa) const {
    const double per_h2 = 1.0 / (substep_s * substep_s);
    std::size_t skipped = 0;
    for (const DihedralConstraint& c : items_) {
        const auto hinge = hinge_value(c, x);
        if (!hinge) {
            ++skipped;
            continue;
        }
        double weight = 0;
        for (std::size_t j = 0; j < 4; ++j)
            weight += inverse_mass[static_cast<std::size_t>(c.p[j])] * hinge->gradient[j].squaredNorm();
        if (weight == 0.0)
            continue;
        const double softness = c.compliance * per_h2;
        const double multiplier = -hinge->error_rad / std::max(weight + softness, kappa * softness);
        for (std::size_t j = 0; j < 4; ++j) {
            const auto i = static_cast<std::size_t>(c.p[j]);
            x[i] += inverse_mass[i] * multiplier * hinge->gradient[j];
        }
    }
    return skipped;
}

} // namespace fascicle::solver
