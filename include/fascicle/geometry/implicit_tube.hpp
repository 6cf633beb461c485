#pragma once
// A tube swept along a smooth curve with an elliptic cross-section that changes on the way: shafts, ridges,
// tendons.

#include "fascicle/geometry/implicit.hpp"

#include <vector>

namespace fascicle {

/// One control point of a tube. wide_direction: the direction of the half axis `wide`, only its part
/// perpendicular to the curve counts and it must not be parallel to the curve; the other half axis is
/// `narrow`. Both > 0.
struct TubeStation {
    Vec3 point;
    double wide;
    double narrow;
    Vec3 wide_direction = Vec3::UnitX();
};

/// Point of a Catmull-Rom span between b and c (a before, d after), t in [0, 1].
template <typename T>
T catmull_rom(const T& a, const T& b, const T& c, const T& d, double t) {
    const double t2 = t * t, t3 = t2 * t;
    return 0.5 * ((2.0 * b) + t * (c - a) + t2 * (2.0 * a - 5.0 * b + 4.0 * c - d) +
                  t3 * (3.0 * b - 3.0 * c + d - a));
}

/// Catmull-Rom curve through the stations (at least 2), each span cut into `pieces` straight pieces, ends
/// closed by half ellipsoids as deep as `narrow`. The value is the ellipsoid estimate of ellipsoid_shape in
/// the cross-section at the nearest point of the curve; it is the distance for a round tube.
ImplicitShape tube_shape(const std::vector<TubeStation>& stations, int pieces = 6);

} // namespace fascicle
