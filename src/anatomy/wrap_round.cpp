#include "anatomy/wrap_round.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fascicle {

Vec2 CircleRoute::point(double radius, double share) const {
    const double angle = start_angle + turn * share * arc_rad;
    return radius * Vec2(std::cos(angle), std::sin(angle));
}

CircleRoute circle_route(const Vec2& p, const Vec2& q, double radius, int turn) {
    // Rounding may take a point that lies on the circle inside.
    const double at_p = std::acos(std::min(1.0, radius / p.norm()));
    const double at_q = std::acos(std::min(1.0, radius / q.norm()));
    const double angle_p = std::atan2(p.y(), p.x());
    double between = turn * (std::atan2(q.y(), q.x()) - angle_p); // in (-2 pi, 2 pi)
    if (between < 0)
        between += 2 * std::numbers::pi;
    return {angle_p + turn * at_p, between - at_p - at_q, turn};
}

bool crosses_circle(const Vec2& p, const Vec2& q, double radius) {
    const Vec2 d = q - p;
    const double squared = d.squaredNorm();
    if (!(squared > 0))
        return false;
    const double t = -p.dot(d) / squared;
    return t > 0 && t < 1 && (p + t * d).squaredNorm() < radius * radius;
}

int shorter_turn(const Vec2& p, const Vec2& q) {
    return p.x() * q.y() - p.y() * q.x() >= 0 ? 1 : -1;
}

int arc_steps(double arc_rad) {
    return 2 + static_cast<int>(arc_rad * 36 / std::numbers::pi);
}

} // namespace fascicle
