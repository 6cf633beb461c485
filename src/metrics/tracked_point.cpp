#include "fascicle/metrics/tracked_point.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle {

double TrackedPoint::look(const SolidQuery& solid, const Vec3& q, double far) {
    const double d2 = solid.bvh().closest_squared_distance(q, far, triangle);
    const double d = d2 < far * far ? std::sqrt(d2) : far;
    // A little less than the radius: the two balls of a point pushed straight through a face touch, and
    // rounding must not make them overlap.
    const double rounding = 1e-9 * d + 1e-12 * q.lpNorm<Eigen::Infinity>();
    const double clear = std::max(0.0, solid.clear_radius(q, d) - rounding);
    if (radius < 0.0 || (q - point).norm() >= radius + clear)
        inside = solid.inside(q);
    point = q;
    radius = clear;
    return d;
}

} // namespace fascicle
