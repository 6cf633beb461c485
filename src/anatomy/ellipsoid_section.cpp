#include "anatomy/ellipsoid_section.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fascicle {

EllipsoidSections::EllipsoidSections(const Vec3& radii, const Vec3& p, const Vec3& q)
    : radii_(radii), p_(p), q_(q), from_(p.cwiseQuotient(radii)), to_(q.cwiseQuotient(radii)) {
    const Vec3 along = (to_ - from_).normalized();
    across_ = along.unitOrthogonal();
    up_ = along.cross(across_);
}

EllipsoidSections::Section EllipsoidSections::section(double angle_rad) const {
    Section s;
    s.normal = std::cos(angle_rad) * across_ + std::sin(angle_rad) * up_;
    s.centre = s.normal.dot(from_) * s.normal;
    s.radius = std::sqrt(std::max(0.0, 1 - s.centre.squaredNorm()));
    s.axis_x = (from_ - s.centre).normalized();
    s.axis_y = s.normal.cross(s.axis_x);
    const Vec3 a = from_ - s.centre, b = to_ - s.centre;
    s.route = circle_route(Vec2(a.dot(s.axis_x), a.dot(s.axis_y)), Vec2(b.dot(s.axis_x), b.dot(s.axis_y)),
                           s.radius, 1);
    s.route.arc_rad = std::max(0.0, s.route.arc_rad);
    return s;
}

double EllipsoidSections::angle_through(const Vec3& x) const {
    // The path counter-clockwise about n passes the chord on the side of (chord x n) ... of -(n x chord).
    const Vec3 along = (to_ - from_).normalized();
    const Vec3 side = x.cwiseQuotient(radii_) - from_;
    const Vec3 normal = side.cross(along); // n x along points away from the side that a left turn passes
    return std::atan2(normal.dot(up_), normal.dot(across_));
}

Vec3 EllipsoidSections::point(const Section& s, double share) const {
    const Vec2 at = s.route.point(s.radius, share);
    return (s.centre + at.x() * s.axis_x + at.y() * s.axis_y).cwiseProduct(radii_);
}

double EllipsoidSections::arc_length(const Section& s) const {
    constexpr int steps = 32;
    double sum = 0;
    Vec3 last = point(s, 0);
    for (int i = 1; i <= steps; ++i) {
        const Vec3 next = point(s, static_cast<double>(i) / steps);
        sum += (next - last).norm();
        last = next;
    }
    return sum;
}

double EllipsoidSections::length(const Section& s) const {
    return (point(s, 0) - p_).norm() + arc_length(s) + (point(s, 1) - q_).norm();
}

double EllipsoidSections::shortest_angle() const {
    constexpr int tries = 16;
    const double step = 2 * std::numbers::pi / tries;
    const auto cost = [&](double angle) { return length(section(angle)); };
    double best = 0, least = cost(0);
    for (int i = 1; i < tries; ++i)
        if (const double here = cost(i * step); here < least) {
            least = here;
            best = i * step;
        }
    double low = best - step, high = best + step;
    const double golden = (std::sqrt(5.0) - 1) / 2;
    double left = high - golden * (high - low), right = low + golden * (high - low);
    double at_left = cost(left), at_right = cost(right);
    while (high - low > 0.01) {
        if (at_left <= at_right) {
            high = right;
            right = left;
            at_right = at_left;
            at_left = cost(left = high - golden * (high - low));
        } else {
            low = left;
            left = right;
            at_left = at_right;
            at_right = cost(right = low + golden * (high - low));
        }
    }
    return (low + high) / 2;
}

} // namespace fascicle
