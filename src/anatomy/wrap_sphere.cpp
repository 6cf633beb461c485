#include "anatomy/wrap_round.hpp"
#include "fascicle/anatomy/wrap_surface.hpp"

#include <cmath>

namespace fascicle {
namespace {

/// Unit vector of the plane through p, q and the centre, at a right angle to p (unit vector u). Where the line passes
/// through the centre every plane is as good: the one towards the constrained side, else one that is always the same.
Vec3 second_axis(const WrapSurface& sphere, const Vec3& u, const Vec3& q) {
    const Vec3 across = q - q.dot(u) * u;
    if (across.norm() > 1e-9 * q.norm())
        return across.normalized();
    Vec3 wanted = Vec3::Zero();
    if (sphere.side_sign != 0)
        wanted[sphere.side_axis] = sphere.side_sign;
    wanted -= wanted.dot(u) * u;
    return wanted.norm() > 1e-6 ? wanted.normalized() : Vec3(u.unitOrthogonal());
}

} // namespace

WrapContact wrap_sphere(const WrapSurface& sphere, const Vec3& p, const Vec3& q, std::vector<Vec3>* curve) {
    const double r = sphere.radius;
    if (p.norm() < r || q.norm() < r)
        return {WrapOutcome::inside};
    const Vec3 u = p.normalized(), v = second_axis(sphere, u, q);
    const Vec2 flat_p(p.norm(), 0), flat_q(q.dot(u), q.dot(v));
    if (!crosses_circle(flat_p, flat_q, r))
        return {};
    WrapContact contact{WrapOutcome::wrapped};
    CircleRoute route = circle_route(flat_p, flat_q, r, 1); // v points to q: the shorter way
    if (sphere.side_sign != 0) {
        const bool p_there = on_side(p[sphere.side_axis], sphere.side_sign);
        const bool q_there = on_side(q[sphere.side_axis], sphere.side_sign);
        if (p_there || q_there)
            contact.outcome = WrapOutcome::mandatory;
        if (!p_there || !q_there) {
            // The long way, if on the whole it leads from the ends to the constrained side.
            const CircleRoute other = circle_route(flat_p, flat_q, r, -1);
            const Vec2 lead = other.point(r, 0) - flat_p + other.point(r, 1) - flat_q;
            if ((lead.x() * u + lead.y() * v)[sphere.side_axis] * sphere.side_sign >= 0)
                route = other;
        }
    }
    const auto lift = [&](double share) {
        const Vec2 x = route.point(r, share);
        return Vec3(x.x() * u + x.y() * v);
    };
    contact.first = lift(0);
    contact.second = lift(1);
    contact.surface_length = r * route.arc_rad;
    if (curve != nullptr)
        for (int i = 0, steps = arc_steps(route.arc_rad); i <= steps; ++i)
            curve->push_back(lift(static_cast<double>(i) / steps));
    return contact;
}

} // namespace fascicle
