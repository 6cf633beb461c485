#pragma once
// Whether a point lies in a polygon of the plane.

#include "fascicle/base/types.hpp"

namespace fascicle {

/// Even-odd rule; polygon: corners in order, either way round, closed by itself. A point on the border may be either.
inline bool inside_polygon(const Vec2& p, const std::vector<Vec2>& polygon) {
    bool inside = false;
    for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
        const Vec2 &a = polygon[i], &b = polygon[j];
        if ((a.y() > p.y()) != (b.y() > p.y()) &&
            p.x() < (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()) + a.x())
            inside = !inside;
    }
    return inside;
}

} // namespace fascicle
