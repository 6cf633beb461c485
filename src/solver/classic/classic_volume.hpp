#pragma once
// Enclosed volume: C = V - pressure V0 (Mueller et al. 2007; paper eq. 3), one projection for the whole
// surface.

#include "fascicle/base/bytes_of.hpp"
#include "solver/classic/classic_state.hpp"

namespace fascicle::classic {

/// published: V = 1/6 sum p2.(p0 x p1) about the scene's origin, but the accumulated gradients lack the 1/6
/// (notes 1.3): dp_i = -(V - pressure V0) g_i / sum_j |g_j|^2 with g = 6 grad V, so one projection takes away
/// 1/6 of the error to first order, and fixed vertices are in the sum as if they could move. meant: g = grad
/// V and weights: dp_i = -w_i (V - pressure V0) grad_i V / sum_j w_j |grad_j V|^2. Both skip a surface
/// without gradient, where the program would divide by zero. rest_volume: V0, cubic units.
class VolumeConstraint {
public:
    VolumeConstraint(const Points& rest, std::vector<Tri> triangles, double pressure, bool meant);
    void project(ClassicState& state);
    double rest_volume() const { return rest_volume_; }
    std::size_t bytes() const { return bytes_of(triangles_, gradient_); }

private:
    /// Volume of the candidates; fills gradient_ with 6 grad V.
    double accumulate(const Points& p);

    std::vector<Tri> triangles_;
    double pressure_;
    bool meant_;
    double rest_volume_ = 0;
    Vec3 centre_ = Vec3::Zero(); ///< meant: the sums run about the rest centroid, to lose no digits
    Points gradient_;
};

} // namespace fascicle::classic
