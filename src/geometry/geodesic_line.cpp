#include "fascicle/geometry/geodesic_line.hpp"

#include "fascicle/base/assert.hpp"
#include "geometry/surface_strip.hpp"

#include <algorithm>

namespace fascicle {

GeodesicLine geodesic_line(GeodesicSearch& search, const SurfacePoint& from, const SurfacePoint& to,
                           double limit) {
    FASCICLE_ASSERT(from.triangle >= 0 && to.triangle >= 0);
    const SurfaceGraph& graph = search.graph();
    if (from.triangle == to.triangle)
        return {{{-1, -1, from.triangle, 0.0, from.point}, {-1, -1, to.triangle, 0.0, to.point}},
                (to.point - from.point).norm()};
    GeodesicLimits limits;
    limits.distance = limit;
    limits.until_triangle = to.triangle;
    search.run(std::span<const SurfacePoint>(&from, 1), limits, WaveFront::edges);
    double best = std::numeric_limits<double>::infinity();
    int last = -1;
    for (const int v : graph.triangle(to.triangle)) {
        const double whole = search.distance(v) + (graph.position(v) - to.point).norm();
        if (whole < best) {
            best = whole;
            last = v;
        }
    }
    if (last < 0)
        return {};
    std::vector<int> path;
    for (int v = last; v >= 0; v = search.parent(v))
        path.push_back(v);
    std::reverse(path.begin(), path.end());
    SurfaceStrip strip(graph, from, to, path);
    strip.straighten();
    return strip.line();
}

} // namespace fascicle
