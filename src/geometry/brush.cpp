#include "fascicle/geometry/brush.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/geometry/geodesic_line.hpp"
#include "fascicle/geometry/lasso.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle {
namespace {

/// Points along the way, the ends included, at most `gap` apart. Only the last when there is no way.
std::vector<SurfacePoint> way_points(GeodesicSearch& search, const SurfacePoint& from, const SurfacePoint& to,
                                     double radius) {
    if (from.triangle < 0 || to.triangle < 0)
        return {to};
    const double limit = 3.0 * (to.point - from.point).norm() + radius;
    const GeodesicLine line = geodesic_line(search, from, to, limit);
    if (line.points.empty())
        return {to};
    std::vector<SurfacePoint> points;
    const double gap = 0.25 * radius;
    for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
        const LinePoint &a = line.points[i], &b = line.points[i + 1];
        const double length = (b.point - a.point).norm();
        // A radius is at most a few thousand gaps of any line worth painting; the cap keeps memory in proportion.
        const int pieces = static_cast<int>(std::min(std::ceil(length / gap), 10000.0));
        for (int k = 0; k < std::max(pieces, 1); ++k) {
            SurfacePoint p;
            p.triangle = a.triangle;
            p.point = a.point + (b.point - a.point) * (double(k) / std::max(pieces, 1));
            // Crossings closer than the gap need no disc each.
            if (points.empty() || (p.point - points.back().point).norm() > 0.5 * gap)
                points.push_back(p);
        }
    }
    points.push_back(to);
    return points;
}

std::vector<int> touched(GeodesicSearch& search, const std::vector<SurfacePoint>& points,
                         const Brush& brush) {
    const SurfaceGraph& graph = search.graph();
    std::optional<ScreenEye> eye;
    if (brush.eye)
        eye = ScreenEye{false, *brush.eye};
    std::vector<int> vertices;
    if (brush.reach == BrushReach::sphere) {
        for (int v = 0; v < graph.vertex_count(); ++v)
            if (graph.topology().vertex_component(v) >= 0)
                for (const SurfacePoint& p : points)
                    if ((graph.position(v) - p.point).squaredNorm() <= brush.radius * brush.radius) {
                        vertices.push_back(v);
                        break;
                    }
    } else {
        GeodesicLimits limits;
        limits.distance = brush.radius;
        if (eye)
            limits.passes = [&](int t) { return faces_eye(graph, t, *eye); };
        search.run(points, limits);
        vertices = search.reached();
    }
    if (eye)
        std::erase_if(vertices, [&](int v) {
            return !vertex_faces_eye(graph, v, *eye) ||
                   (brush.visible_only && !vertex_visible(graph, v, *eye));
        });
    if (vertices.empty())
        vertices.push_back(nearest_corner(graph, points.back()));
    std::sort(vertices.begin(), vertices.end());
    return vertices;
}

} // namespace

std::vector<int> brush_vertices(GeodesicSearch& search, const SurfacePoint& at, const Brush& brush) {
    FASCICLE_ASSERT(std::isfinite(brush.radius) && brush.radius > 0.0);
    return at.triangle < 0 ? std::vector<int>{} : touched(search, {at}, brush);
}

std::vector<int> stroke_vertices(GeodesicSearch& search, const SurfacePoint& from, const SurfacePoint& to,
                                 const Brush& brush) {
    FASCICLE_ASSERT(std::isfinite(brush.radius) && brush.radius > 0.0);
    return to.triangle < 0 ? std::vector<int>{}
                           : touched(search, way_points(search, from, to, brush.radius), brush);
}

} // namespace fascicle
