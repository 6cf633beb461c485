#include "editor/paint/paint_touch.hpp"

#include "fascicle/geometry/region_ops.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fascicle::editor {

namespace {

/// Where distance along the surface equals the radius, by linear interpolation in each triangle round the reached vertices.
Points distance_ring(GeodesicSearch& search, const SurfacePoint& at, const Brush& brush) {
    const SurfaceGraph& graph = search.graph();
    GeodesicLimits limits;
    limits.distance = brush.radius + 2 * graph.mean_edge_length();
    std::optional<ScreenEye> eye;
    if (brush.eye) {
        eye = ScreenEye{false, *brush.eye};
        limits.passes = [&](int t) { return faces_eye(graph, t, *eye); };
    }
    search.run(std::span(&at, 1), limits);
    Points segments;
    for (const int v : search.reached()) {
        if (search.distance(v) > brush.radius)
            continue;
        for (const int t : graph.topology().vertex_triangles(v)) {
            const Tri& tri = graph.triangle(t);
            int lowest_inside = -1, crossings = 0;
            Vec3 ends[2];
            bool whole = true;
            for (std::size_t k = 0; k < 3; ++k) {
                const int a = tri[k], b = tri[(k + 1) % 3];
                const double da = search.distance(a), db = search.distance(b);
                whole = whole && std::isfinite(da);
                if (da <= brush.radius && (lowest_inside < 0 || a < lowest_inside))
                    lowest_inside = a;
                if ((da <= brush.radius) != (db <= brush.radius) && std::isfinite(da + db) && crossings < 2)
                    ends[crossings++] = graph.position(a) + (brush.radius - da) / (db - da) *
                                                                (graph.position(b) - graph.position(a));
            }
            if (whole && crossings == 2 && lowest_inside == v)
                segments.insert(segments.end(), {ends[0], ends[1]});
        }
    }
    return segments;
}

Points laid_circle(const SurfaceGraph& graph, const SurfacePoint& at, double radius) {
    constexpr int pieces = 72;
    const Vec3 normal = graph.normal(at.triangle);
    const Vec3 u = normal.unitOrthogonal(), v = normal.cross(u);
    Points ring;
    for (int i = 0; i <= pieces; ++i) {
        const double angle = 2 * std::numbers::pi * i / pieces;
        const Vec3 p = at.point + radius * (std::cos(angle) * u + std::sin(angle) * v);
        const SurfacePoint foot = graph.tree().closest(p, radius, at.triangle);
        ring.push_back(foot.triangle >= 0 ? foot.point : p);
    }
    Points segments;
    for (int i = 0; i < pieces; ++i)
        segments.insert(segments.end(),
                        {ring[static_cast<std::size_t>(i)], ring[static_cast<std::size_t>(i + 1)]});
    return segments;
}

} // namespace

PaintAim paint_aim(const PaintSettings& settings, const PaintView& view, const SurfacePoint& at,
                   const Vec2& pointer, double unit_mm, double scale) {
    PaintAim aim{at, pointer, 0, 0};
    const double unit_per_px = view.units_per_pixel(at.point);
    aim.radius = settings.pixels ? settings.radius_px * scale * unit_per_px : settings.radius_mm / unit_mm;
    aim.radius = std::max(aim.radius, 1e-9);
    aim.radius_px = aim.radius / unit_per_px;
    return aim;
}

Brush paint_brush(const PaintSettings& settings, const PaintView& view, const PaintAim& aim) {
    Brush brush;
    brush.radius = aim.radius;
    if (settings.reach == PaintReach::sphere) {
        brush.reach = BrushReach::sphere;
    } else {
        brush.eye = view.eye();
        brush.visible_only = true;
    }
    return brush;
}

std::vector<int> under_screen_circle(const SurfaceGraph& graph, const PaintSettings& settings,
                                     const PaintView& view, const Vec2& from, const PaintAim& to) {
    const SurfaceRegion region = lasso(graph, view.matrix(), swept_circle(from, to.pointer, to.radius_px),
                                       settings.through ? LassoReach::through : LassoReach::visible);
    std::vector<int> vertices = region.vertices();
    if (vertices.empty() && to.at.triangle >= 0) // a click always does something
        vertices.push_back(nearest_corner(graph, to.at));
    return vertices;
}

const std::vector<int>& PaintFills::smart(const SurfaceGraph& graph, int triangle, double crease_rad) {
    const Tri& tri = graph.triangle(triangle);
    const bool same = graph_ == &graph && kind_ == 1 && crease_ == crease_rad && filled_.contains(tri[0]) &&
                      filled_.contains(tri[1]) && filled_.contains(tri[2]);
    if (!same) {
        SmartFill fill;
        fill.triangle = triangle;
        fill.crease_rad = crease_rad;
        filled_ = smart_fill(graph, fill);
        vertices_ = filled_.vertices();
        graph_ = &graph;
        kind_ = 1;
        crease_ = crease_rad;
    }
    return vertices_;
}

const std::vector<int>& PaintFills::bucket(const SurfaceGraph& graph, const SurfaceRegion* area,
                                           const SurfaceRegion& all_areas, int vertex, bool erase) {
    const int kind = erase ? 3 : 2;
    const SurfaceRegion none(graph.vertex_count());
    const SurfaceRegion& barrier = erase ? (area != nullptr ? *area : none) : all_areas;
    if (graph_ == &graph && kind_ == kind && barrier_ == barrier &&
        (filled_.contains(vertex) || (filled_.empty() && barrier.contains(vertex) != erase)))
        return vertices_;
    filled_ = erase ? barrier - bucket_erase(graph, barrier, vertex)
                    : bucket_fill(graph, barrier, vertex) - barrier;
    vertices_ = filled_.vertices();
    barrier_ = barrier;
    graph_ = &graph;
    kind_ = kind;
    return vertices_;
}

std::vector<int> would_change(const Scene& scene, const SurfaceGraph& graph, const actions::AreaKey& key,
                              actions::StrokeMode mode, const std::vector<actions::AreaKey>& locked,
                              std::vector<int> touched) {
    const auto fits = [&](const AttachmentArea* area) {
        return area != nullptr && area->vertices.vertex_count() == graph.vertex_count();
    };
    for (const actions::AreaKey& lock : locked)
        if (const AttachmentArea* area = lock.bone == key.bone ? actions::find_area(scene, lock) : nullptr;
            fits(area))
            std::erase_if(touched, [&](int v) { return area->vertices.contains(v); });
    const AttachmentArea* own = actions::find_area(scene, key);
    if (!fits(own))
        return mode == actions::StrokeMode::paint ? touched : std::vector<int>{};
    if (mode == actions::StrokeMode::smooth) {
        const SurfaceRegion within(graph.vertex_count(), touched);
        const SurfaceRegion smooth = smooth_border(graph, own->vertices, 4, &within);
        std::erase_if(touched, [&](int v) { return smooth.contains(v) == own->vertices.contains(v); });
    } else {
        const bool wanted = mode == actions::StrokeMode::paint;
        std::erase_if(touched, [&](int v) { return own->vertices.contains(v) == wanted; });
    }
    return touched;
}

Points cursor_ring(GeodesicSearch& search, const SurfacePoint& at, const Brush& brush) {
    // Within few triangles interpolated distances make no circle.
    const bool coarse = brush.radius < 4 * search.graph().mean_edge_length();
    return brush.reach == BrushReach::sphere || coarse ? laid_circle(search.graph(), at, brush.radius)
                                                       : distance_ring(search, at, brush);
}

} // namespace fascicle::editor
