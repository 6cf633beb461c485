#pragma once
// From the paper's stiffness k in [0, 1] to an XPBD compliance that does not depend on the substep.

#include <limits>

namespace fascicle::solver {

/// Substep at which a stiffness k is read, that of the published program: one Gauss-Seidel projection with this substep removes the share k
/// of the error.
inline constexpr double reference_substep_s = 1e-3;

/// alpha = h^2 W (1 - k) / k with h the reference substep and W = sum_i w_i |grad_i C|^2 at rest (methods
/// notes 1.2, exact for one projection: the share removed is W / (W + alpha / h^2) = k). k >= 1 gives 0
/// (rigid), k <= 0 infinity (no constraint). Unit: that of W times s^2.
inline double compliance_from_stiffness(double stiffness, double weighted_gradient_norm) {
    if (stiffness >= 1.0)
        return 0.0;
    if (stiffness <= 0.0)
        return std::numeric_limits<double>::infinity();
    return reference_substep_s * reference_substep_s * weighted_gradient_norm * (1.0 - stiffness) / stiffness;
}

} // namespace fascicle::solver
