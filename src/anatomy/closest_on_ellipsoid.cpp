#include "fascicle/anatomy/ellipsoid_geodesic.hpp"

#include <cmath>

namespace fascicle {

/// With x_i = a_i^2 p_i / (t + a_i^2) the foot has F(t) = sum (a_i p_i / (t + a_i^2))^2 - 1 = 0 at the largest root, which
/// lies above -min a_i^2; F falls there, so bisection finds it. Where p_i = 0 in the direction of the smallest radius and the
/// sum of the others stays below 1, the foot leaves that plane: x_i takes what is missing.
Vec3 closest_on_ellipsoid(const Vec3& radii, const Vec3& p) {
    const double scale = radii.maxCoeff();
    const Vec3 a = radii / scale, u = p / scale;
    int least = 0;
    a.minCoeff(&least);
    const double lowest = -a[least] * a[least];
    const auto excess = [&](double t) {
        double sum = -1;
        for (int i = 0; i < 3; ++i) {
            const double share = u[i] == 0.0 ? 0.0 : a[i] * u[i] / (t + a[i] * a[i]);
            sum += share * share;
        }
        return sum;
    };
    double low = lowest, high = u.norm() + 1; // a_i |u_i| / (t + a_i^2) <= |u_i| / t as a <= 1: F(high) < 0
    for (int i = 0; i < 200; ++i) {
        const double middle = (low + high) / 2;
        if (middle <= low || middle >= high)
            break;
        (excess(middle) > 0 ? low : high) = middle;
    }
    const double t = high;
    Vec3 foot = Vec3::Zero();
    double rest = 1;
    for (int i = 0; i < 3; ++i) {
        const double below = t + a[i] * a[i];
        foot[i] = u[i] == 0.0 || !(below > 0) ? 0.0 : a[i] * a[i] * u[i] / below;
        rest -= (foot[i] / a[i]) * (foot[i] / a[i]);
    }
    if (std::abs(t - lowest) < 1e-15 && rest > 0)
        foot[least] = std::copysign(
            a[least] * std::sqrt((foot[least] / a[least]) * (foot[least] / a[least]) + rest), u[least]);
    return scale * foot;
}

} // namespace fascicle
