#include "reproduce/surface_distance.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/geometry/bvh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fascicle::reproduce {

SurfaceDistance surface_distance(const Points& a, const Points& b, const std::vector<Tri>& triangles,
                                 double unit_mm) {
    FASCICLE_ASSERT(a.size() == b.size());
    const auto finite = [](const Points& points) {
        return std::all_of(points.begin(), points.end(), [](const Vec3& p) { return p.allFinite(); });
    };
    const double none = std::numeric_limits<double>::quiet_NaN();
    if (a.empty() || triangles.empty() || !finite(a) || !finite(b))
        return {none, none};
    double sum = 0, most = 0;
    const auto one_way = [&](const Points& from, const Points& to) {
        const TriangleBvh tree(to, triangles);
        for (const Vec3& p : from) {
            const double distance = std::sqrt(tree.closest(p).squared_distance);
            sum += distance;
            most = std::max(most, distance);
        }
    };
    one_way(a, b);
    one_way(b, a);
    return {unit_mm * sum / static_cast<double>(2 * a.size()), unit_mm * most};
}

} // namespace fascicle::reproduce
