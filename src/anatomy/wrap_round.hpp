#pragma once
// The plane part of wrapping over spheres and cylinders: a circle and two points outside of it.

#include "fascicle/base/types.hpp"

namespace fascicle {

/// Route round a circle of radius r about the origin, from p to q, both outside of it (distances P, Q >= r).
struct CircleRoute {
    double start_angle = 0; ///< of the first tangent point, rad, from +x
    double arc_rad =
        0;        ///< from the first tangent point to the second, in the direction of `turn`; below 0: the
                  ///< straight line passes by on that side
    int turn = 1; ///< 1 counter-clockwise, -1 clockwise

    Vec2 point(double radius, double share) const;
};

/// turn: 1 or -1.
CircleRoute circle_route(const Vec2& p, const Vec2& q, double radius, int turn);

/// Whether the segment passes through the circle: its nearest point to the centre lies inside, between the ends.
bool crosses_circle(const Vec2& p, const Vec2& q, double radius);

/// The turn (1 or -1) of the shorter way: 1 when q is seen counter-clockwise of p from the centre, by half a turn at most.
int shorter_turn(const Vec2& p, const Vec2& q);

/// Steps of a drawn arc: one in five degrees, and two at least.
int arc_steps(double arc_rad);

/// Whether x lies on the constrained side; 0 counts as positive.
inline bool on_side(double x, int sign) {
    return (x >= 0 ? 1 : -1) == sign;
}

} // namespace fascicle
