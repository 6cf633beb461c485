#pragma once
// Polylines by arc length.

#include "fascicle/geometry/centripetal_spline.hpp"

#include <span>

namespace fascicle::chmd {

double polyline_length(std::span<const Vec3> line);

/// Point at arc share in [0, 1] of a polyline of at least 1 point.
Vec3 point_at_share(std::span<const Vec3> line, double share);

/// `segments` + 1 points at equal arcs of a polyline, ends kept exactly. All points equal when it has no length.
Points equal_arcs(std::span<const Vec3> line, int segments);

/// The centripetal curve through the points (>= 2) as a polyline, `pieces` >= 1 a span.
Points smooth_line(Points points, int pieces);

/// Part of a polyline between two arc shares, 0 <= from < to <= 1, with the points in between.
Points part_of_line(std::span<const Vec3> line, double from, double to);

} // namespace fascicle::chmd
