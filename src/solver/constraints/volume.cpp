#include "solver/constraints/volume.hpp"

namespace fascicle::solver {

VolumeConstraint::VolumeConstraint(const Points& rest, std::vector<Tri> triangles, double pressure)
    : triangles_(std::move(triangles)), gradient_(rest.size(), Vec3::Zero()) {
    rest_volume_ = evaluate(rest);
    wanted_ = pressure * rest_volume_;
}

double VolumeConstraint::evaluate(const Points& x) {
    if (x.empty() || triangles_.empty())
        return 0.0;
    // Scanned bones lie far from the origin: about a vertex the products stay of the size of the surface.
    // For a closed surface neither V nor its gradient depends on this point.
    const Vec3 about = x[static_cast<std::size_t>(triangles_.front()[0])];
    std::fill(gradient_.begin(), gradient_.end(), Vec3::Zero());
    double six_volume = 0;
    for (const Tri& t : triangles_) {
        const auto ia = static_cast<std::size_t>(t[0]), ib = static_cast<std::size_t>(t[1]),
                   ic = static_cast<std::size_t>(t[2]);
        const Vec3 a = x[ia] - about, b = x[ib] - about, c = x[ic] - about;
        const Vec3 bc = b.cross(c);
        six_volume += a.dot(bc);
        gradient_[ia] += bc / 6.0;
        gradient_[ib] += c.cross(a) / 6.0;
        gradient_[ic] += a.cross(b) / 6.0;
    }
    return six_volume / 6.0;
}

void VolumeConstraint::project(Points& x, const std::vector<double>& inverse_mass) {
    const double error = evaluate(x) - wanted_;
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
