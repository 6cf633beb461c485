#include "fascicle/geometry/line_region.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle {

std::optional<SurfaceRegion> enclosed_by_lines(const SurfaceGraph& graph,
                                               const std::vector<GeodesicLine>& lines) {
    if (lines.empty() || lines.front().points.empty())
        return std::nullopt;
    SurfaceRegion region(graph.vertex_count());
    SurfaceRegion crossed(static_cast<int>(graph.topology().edges().size())); // an odd number of times
    for (const GeodesicLine& line : lines)
        for (const LinePoint& p : line.points) {
            if (p.vertex >= 0)
                region.insert(p.vertex);
            else if (p.edge >= 0)
                crossed.contains(p.edge) ? crossed.erase(p.edge) : crossed.insert(p.edge);
        }
    const int start = graph.triangle(lines.front().points.front().triangle)[0];
    const int component = graph.topology().vertex_component(start);
    SurfaceRegion seen = region;
    std::vector<std::vector<int>> parts;
    std::size_t largest = 0;
    double most = -1;
    for (int seed = 0; seed < graph.vertex_count(); ++seed) {
        if (seen.contains(seed) || graph.topology().vertex_component(seed) != component)
            continue;
        std::vector<int> part{seed};
        seen.insert(seed);
        double area = 0;
        for (std::size_t k = 0; k < part.size(); ++k) {
            area += graph.vertex_area(part[k]);
            const auto neighbours = graph.topology().vertex_neighbours(part[k]);
            const auto edges = graph.vertex_edges(part[k]);
            for (std::size_t n = 0; n < neighbours.size(); ++n)
                if (!seen.contains(neighbours[n]) && !crossed.contains(edges[n])) {
                    seen.insert(neighbours[n]);
                    part.push_back(neighbours[n]);
                }
        }
        if (area > most) {
            most = area;
            largest = parts.size();
        }
        parts.push_back(std::move(part));
    }
    if (parts.size() < 2)
        return std::nullopt;
    for (std::size_t i = 0; i < parts.size(); ++i)
        if (i != largest)
            region.insert(parts[i]);
    return region;
}

SurfaceRegion strip_along_lines(GeodesicSearch& search, const std::vector<SurfacePoint>& ends,
                                const std::vector<GeodesicLine>& lines, double half_width) {
    const SurfaceGraph& graph = search.graph();
    SurfaceRegion region(graph.vertex_count());
    std::vector<SurfacePoint> along = ends;
    const double gap = std::max(0.5 * half_width, 0.25 * graph.mean_edge_length());
    for (const GeodesicLine& line : lines)
        for (std::size_t i = 0; i < line.points.size(); ++i) {
            const LinePoint& p = line.points[i];
            if (p.vertex >= 0) {
                region.insert(p.vertex);
            } else if (p.edge >= 0) {
                const Edge& e = graph.topology().edges()[static_cast<std::size_t>(p.edge)];
                region.insert(p.share <= 0.5 ? e.a : e.b);
            }
            if (i + 1 == line.points.size())
                continue;
            const Vec3 step = line.points[i + 1].point - p.point;
            const int pieces = static_cast<int>(std::clamp(std::ceil(step.norm() / gap), 1.0, 1e4));
            for (int k = 0; k < pieces; ++k) {
                along.emplace_back();
                along.back().triangle = p.triangle;
                along.back().point = p.point + step * (double(k) / pieces);
            }
        }
    for (const SurfacePoint& foot : ends)
        region.insert(nearest_corner(graph, foot));
    GeodesicLimits limits;
    limits.distance = half_width;
    search.run(along, limits);
    region.insert(search.reached());
    return region;
}

} // namespace fascicle
