#include "solver/classic/classic_volume.hpp"

#include "fascicle/geometry/volume.hpp"

#include <Eigen/Geometry>

namespace fascicle::classic {

VolumeConstraint::VolumeConstraint(const Points& rest, std::vector<Tri> triangles, double pressure,
                                   bool meant)
    : triangles_(std::move(triangles)), pressure_(pressure), meant_(meant) {
    if (meant_)
        centre_ = surface_centroid(rest, triangles_);
    rest_volume_ = accumulate(rest);
}

double VolumeConstraint::accumulate(const Points& p) {
    gradient_.assign(p.size(), Vec3::Zero());
    double sum = 0.0;
    for (const Tri& t : triangles_) {
        const auto a = static_cast<std::size_t>(t[0]);
        const auto b = static_cast<std::size_t>(t[1]);
        const auto c = static_cast<std::size_t>(t[2]);
        const Vec3 pa = p[a] - centre_, pb = p[b] - centre_, pc = p[c] - centre_;
        const Vec3 ab = pa.cross(pb);
        sum += ab.dot(pc);
        gradient_[c] += ab;
        gradient_[b] += pc.cross(pa);
        gradient_[a] += pb.cross(pc);
    }
    return sum / 6.0;
}

void VolumeConstraint::project(ClassicState& state) {
    const double error = accumulate(state.candidate) - pressure_ * rest_volume_;
    const double scale = meant_ ? 1.0 / 6.0 : 1.0; // the factor that the program forgets
    double sum = 0.0;
    for (std::size_t i = 0; i < state.size(); ++i)
        sum += state.inverse_mass[i] * (scale * gradient_[i]).squaredNorm();
    const double share = error / sum;
    if (!std::isfinite(share))
        return;
    for (std::size_t i = 0; i < state.size(); ++i)
        state.candidate[i] -= share * state.inverse_mass[i] * scale * gradient_[i];
}

} // namespace fascicle::classic
