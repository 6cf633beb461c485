#pragma once
// Distance constraints C = |xa - xb| - d, XPBD with one sweep per substep.
// Sources: Mueller et al. 2007 (projection), Macklin et al. 2016 (compliance).

#include "fascicle/base/bytes_of.hpp"
#include "fascicle/base/types.hpp"

namespace fascicle::solver {

struct DistanceConstraint {
    int a = 0;
    int b = 0;
    double rest = 0;       ///< d, scene units
    double compliance = 0; ///< alpha, s^2 (unit masses); 0 rigid, infinite: dropped by add()
    double along = 0;      ///< (u.v)^2 of its direction and the fibres', see active_strain.hpp
};

/// Value and gradients: grad_a = n, grad_b = -n with n = (xa - xb) / |xa - xb|.
/// Coincident points (|xa - xb| < 1e-9 d) have no direction: n is zero.
struct DistanceValue {
    double value = 0;
    Vec3 gradient_a = Vec3::Zero();
};
DistanceValue distance_value(const Vec3& xa, const Vec3& xb, double rest);

class DistanceConstraints {
public:
    void add(const DistanceConstraint& constraint);
    std::size_t size() const { return items_.size(); }
    std::size_t bytes() const { return bytes_of(items_, rest_); }

    const std::vector<DistanceConstraint>& items() const { return items_; }

    /// One Gauss-Seidel sweep in the order added: dx_i = w_i grad_i dlambda,
    /// dlambda = -C / max(wa + wb + alpha / h^2, kappa alpha / h^2), the multiplier starting from zero in every substep
    /// h (s). x: V points; inverse_mass: V values, 0 for points that must not move; kappa: 1, or balance_of() next to a
    /// coarse correction.
    void project(Points& x, const std::vector<double>& inverse_mass, double substep_s,
                 double kappa = 1.0) const;

    /// Rest lengths for fibres of this share of their length: those added, times active_edge_scale(along, share).
    void set_active_length(double share);

private:
    std::vector<DistanceConstraint> items_;
    std::vector<double> rest_; ///< as added; empty until it is needed
};

} // namespace fascicle::solver
