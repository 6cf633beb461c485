#include "anatomy/wrap_round.hpp"
#include "fascicle/anatomy/wrap_surface.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle {
namespace {

/// Height of the path's nearest point to the axis, and that point's place across it: where the two lines pass each other.
Vec2 nearest_to_axis(const Vec2& p, const Vec2& q) {
    const Vec2 d = q - p;
    const double squared = d.squaredNorm();
    return squared > 0 ? Vec2(p - (p.dot(d) / squared) * d) : p;
}

/// Outcome by the rules for a constrained side.
WrapOutcome constrained_outcome(const WrapSurface& cylinder, const Vec3& p, const Vec3& q, bool crosses) {
    const auto there = [&](double x) { return on_side(x, cylinder.side_sign); };
    const int axis = cylinder.side_axis;
    if (!there(p[axis]) && !there(q[axis]))
        return WrapOutcome::wrapped;
    if (crosses)
        return WrapOutcome::mandatory;
    const Vec2 near = nearest_to_axis(p.head<2>(), q.head<2>());
    double near_value = 0;
    if (axis < 2) {
        near_value = near[axis];
    } else {
        const Vec2 d = (q - p).head<2>();
        const double share = d.squaredNorm() > 0 ? (near - p.head<2>()).dot(d) / d.squaredNorm() : 0.0;
        near_value = p.z() + share * (q.z() - p.z());
    }
    return there(p[axis]) != there(q[axis]) && !there(near_value) ? WrapOutcome::wrapped : WrapOutcome::none;
}

/// Of the two routes the one whose tangent points lie on the constrained side; p's decide, then q's, then the shorter one.
/// z of a tangent point stands for all heights here, so a side along the axis is told by the ends alone.
int constrained_turn(const WrapSurface& cylinder, const Vec3& p, const Vec3& q, int shorter) {
    const double r = cylinder.radius;
    const auto there = [&](int turn, double share, double height) {
        const Vec2 x = circle_route(p.head<2>(), q.head<2>(), r, turn).point(r, share);
        const double value = cylinder.side_axis < 2 ? x[cylinder.side_axis] : height;
        return on_side(value, cylinder.side_sign);
    };
    const bool p_left = there(1, 0, p.z()), p_right = there(-1, 0, p.z());
    if (p_left != p_right)
        return p_left ? 1 : -1;
    const bool q_left = there(1, 1, q.z()), q_right = there(-1, 1, q.z());
    if (q_left != q_right)
        return q_left ? 1 : -1;
    return shorter;
}

} // namespace

WrapContact wrap_cylinder(const WrapSurface& cylinder, const Vec3& p, const Vec3& q,
                          std::vector<Vec3>* curve) {
    const double r = cylinder.radius;
    const Vec2 flat_p = p.head<2>(), flat_q = q.head<2>();
    if (flat_p.norm() < r || flat_q.norm() < r)
        return {WrapOutcome::inside};
    const bool crosses = crosses_circle(flat_p, flat_q, r);
    WrapContact contact;
    int turn = shorter_turn(flat_p, flat_q);
    if (cylinder.side_sign == 0) {
        contact.outcome = crosses ? WrapOutcome::mandatory : WrapOutcome::none;
    } else {
        contact.outcome = constrained_outcome(cylinder, p, q, crosses);
        turn = constrained_turn(cylinder, p, q, turn);
    }
    if (!contact.wraps())
        return contact;
    const CircleRoute route = circle_route(flat_p, flat_q, r, turn);
    if (!(route.arc_rad > 0)) // the straight line passes by on the wanted side
        return {};
    // Unrolled: straight, so heights go with the developed length.
    const double lead_in = std::sqrt(std::max(0.0, flat_p.squaredNorm() - r * r));
    const double lead_out = std::sqrt(std::max(0.0, flat_q.squaredNorm() - r * r));
    const double arc = r * route.arc_rad;
    const double climb = (q.z() - p.z()) / (lead_in + arc + lead_out);
    const auto lift = [&](double share) {
        const Vec2 x = route.point(r, share);
        return Vec3(x.x(), x.y(), p.z() + climb * (lead_in + share * arc));
    };
    contact.first = lift(0);
    contact.second = lift(1);
    const double half = cylinder.length / 2;
    if (std::abs(contact.first.z()) > half && std::abs(contact.second.z()) > half)
        return {};
    contact.surface_length = arc * std::sqrt(1 + climb * climb);
    if (curve != nullptr)
        for (int i = 0, steps = arc_steps(route.arc_rad); i <= steps; ++i)
            curve->push_back(lift(static_cast<double>(i) / steps));
    return contact;
}

} // namespace fascicle
