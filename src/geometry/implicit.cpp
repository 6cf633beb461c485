#include "fascicle/geometry/implicit.hpp"

#include "fascicle/base/assert.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace fascicle {

ImplicitShape sphere_shape(const Vec3& centre, double radius) {
    FASCICLE_ASSERT(radius > 0.0);
    return {[centre, radius](const Vec3& p) { return (p - centre).norm() - radius; }, centre, radius};
}

ImplicitShape round_cone_shape(const Vec3& a, const Vec3& b, double radius_a, double radius_b) {
    FASCICLE_ASSERT(radius_a > 0.0 && radius_b > 0.0);
    const Vec3 axis = b - a;
    const double length = axis.norm();
    const double difference = radius_a - radius_b;
    if (length <= std::abs(difference))
        return difference > 0.0 ? sphere_shape(a, radius_a) : sphere_shape(b, radius_b);
    const Vec3 direction = axis / length;
    // The side of the hull leans by asin(difference / length); a point belongs to an end ball when it lies
    // beyond the circle where side and ball touch.
    const double sine = difference / length;
    const double cosine = std::sqrt(1.0 - sine * sine);
    const auto value = [=](const Vec3& p) {
        const Vec3 q = p - a;
        const double along = q.dot(direction);
        const double across = (q - along * direction).norm();
        const double foot =
            along * cosine - across * sine; // position along the side line, from the touching circle of a
        if (foot < 0.0)
            return q.norm() - radius_a;
        if (foot > length * cosine)
            return (p - b).norm() - radius_b;
        return across * cosine + along * sine - radius_a;
    };
    return {value, 0.5 * (a + b), 0.5 * length + std::max(radius_a, radius_b)};
}

ImplicitShape ellipsoid_shape(const Vec3& centre, const Vec3& radii, const Mat3& axes) {
    FASCICLE_ASSERT(radii.minCoeff() > 0.0);
    const Mat3 to_local = axes.transpose();
    const auto value = [=](const Vec3& p) {
        const Vec3 q = (to_local * (p - centre)).cwiseQuotient(radii);
        const double k0 = q.norm();
        const double k1 = q.cwiseQuotient(radii).norm();
        return k1 > 0.0 ? k0 * (k0 - 1.0) / k1 : -radii.minCoeff();
    };
    return {value, centre, radii.maxCoeff()};
}

ImplicitShape ring_shape(const Vec3& centre, const Vec3& axis, const Vec3& middle, double half_angle,
                         double ring_radius, double tube_radius) {
    FASCICLE_ASSERT(half_angle > 0.0 && ring_radius > 0.0 && tube_radius > 0.0);
    const Vec3 side = axis.cross(middle);
    const double sine = std::sin(half_angle), cosine = std::cos(half_angle);
    const auto value = [=](const Vec3& p) {
        const Vec3 q = p - centre;
        const double x = std::abs(q.dot(side)), y = q.dot(middle), z = q.dot(axis);
        // Beyond the end of the arc the end point is nearest, else the ring itself.
        const bool beyond = cosine * x > sine * y && half_angle < 3.14159;
        const double reach = beyond ? x * sine + y * cosine : std::hypot(x, y);
        const double squared = q.squaredNorm() + ring_radius * ring_radius - 2.0 * ring_radius * reach;
        return (beyond ? std::sqrt(std::max(0.0, squared)) : std::hypot(reach - ring_radius, z)) -
               tube_radius;
    };
    return {value, centre, ring_radius + tube_radius};
}

ImplicitShape box_shape(const Vec3& centre, const Vec3& half, double rounding, const Mat3& axes) {
    FASCICLE_ASSERT(rounding >= 0.0 && half.minCoeff() > rounding);
    const Mat3 to_local = axes.transpose();
    const auto value = [=](const Vec3& p) {
        const Vec3 q = (to_local * (p - centre)).cwiseAbs() - half + Vec3::Constant(rounding);
        return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0) - rounding;
    };
    return {value, centre, half.norm()};
}

double smooth_min(double a, double b, double k) {
    const double lower = std::min(a, b);
    if (k <= 0.0)
        return lower;
    const double h = std::max(k - std::abs(a - b), 0.0) / k;
    return lower - 0.25 * h * h * k;
}

double smooth_max(double a, double b, double k) {
    return -smooth_min(-a, -b, k);
}

ImplicitUnion& ImplicitUnion::add(ImplicitShape shape, double blend) {
    shapes_.push_back(std::move(shape));
    blends_.push_back(blend);
    return *this;
}

double ImplicitUnion::operator()(const Vec3& p) const {
    double value = std::numeric_limits<double>::max();
    for (std::size_t i = 0; i < shapes_.size(); ++i) {
        // The estimates may fall a little short of the distance: leave a tenth of the ball as margin.
        const double at_least = (p - shapes_[i].centre).norm() - 1.1 * shapes_[i].radius;
        if (at_least < value + blends_[i])
            value = smooth_min(value, shapes_[i].value(p), blends_[i]);
    }
    return value;
}

Vec3 implicit_gradient(const Implicit& f, const Vec3& p, double h) {
    static const std::array<Vec3, 4> corners{Vec3(1, -1, -1), Vec3(-1, -1, 1), Vec3(-1, 1, -1),
                                             Vec3(1, 1, 1)};
    Vec3 gradient = Vec3::Zero();
    for (const Vec3& corner : corners)
        gradient += corner * f(p + h * corner);
    return gradient / (4.0 * h);
}

} // namespace fascicle
