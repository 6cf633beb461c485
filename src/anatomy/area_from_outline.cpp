#include "fascicle/anatomy/area_from_outline.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/geometry/geodesic_line.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace fascicle {
namespace {

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

std::vector<SurfacePoint> feet_of(const SurfaceGraph& graph, const Points& outline,
                                  const OutlineAreaRules& rules, const std::string& who) {
    if (outline.empty())
        throw_error(who, "the outline has no points", "points on the bone");
    std::vector<SurfacePoint> feet;
    double sum = 0, most = 0;
    for (const Vec3& p : outline) {
        const SurfacePoint foot = graph.tree().closest(p);
        if (foot.triangle < 0)
            throw_error(who, "the bone has no surface, or a point is not finite", "points on the bone");
        const double distance = std::sqrt(foot.squared_distance);
        sum += distance;
        most = std::max(most, distance);
        if (feet.empty() || (foot.point - feet.back().point).norm() > 0.0)
            feet.push_back(foot);
    }
    const double mean = sum / double(outline.size());
    if (mean > rules.mean_far || most > rules.far)
        throw_error(
            who, "the outline is " + number(mean) + " from the bone on average, " + number(most) + " at most",
            "at most " + number(rules.mean_far) + " and " + number(rules.far) +
                " (scene units): is it another bone's, or in another unit?");
    return feet;
}

/// Geodesic lines from foot to foot, and back to the first when closed.
std::vector<GeodesicLine> lines_between(GeodesicSearch& search, const std::vector<SurfacePoint>& feet,
                                        bool closed, const std::string& who) {
    std::vector<GeodesicLine> lines;
    for (std::size_t i = 0; i + (closed ? 0 : 1) < feet.size(); ++i) {
        const std::size_t next = (i + 1) % feet.size();
        lines.push_back(geodesic_line(search, feet[i], feet[next]));
        if (lines.back().points.empty())
            throw_error(who,
                        "points " + std::to_string(i + 1) + " and " + std::to_string(next + 1) +
                            " lie on parts of the bone that do not hang together",
                        "an outline on one connected surface");
    }
    return lines;
}

/// The vertices on the lines and those that the lines cut off; only the former when they cut nothing off.
SurfaceRegion enclosed(const SurfaceGraph& graph, const std::vector<GeodesicLine>& lines, int start,
                       bool& cuts) {
    SurfaceRegion region(graph.vertex_count());
    SurfaceRegion crossed(static_cast<int>(graph.topology().edges().size())); // an odd number of times
    for (const GeodesicLine& line : lines)
        for (const LinePoint& p : line.points) {
            if (p.vertex >= 0)
                region.insert(p.vertex);
            else if (p.edge >= 0)
                crossed.contains(p.edge) ? crossed.erase(p.edge) : crossed.insert(p.edge);
        }
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
    cuts = parts.size() > 1;
    for (std::size_t i = 0; i < parts.size(); ++i)
        if (i != largest)
            region.insert(parts[i]);
    return region;
}

SurfaceRegion strip_along(GeodesicSearch& search, const std::vector<SurfacePoint>& feet,
                          const std::vector<GeodesicLine>& lines, double half_width) {
    const SurfaceGraph& graph = search.graph();
    SurfaceRegion region(graph.vertex_count());
    std::vector<SurfacePoint> along = feet;
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
    for (const SurfacePoint& foot : feet)
        region.insert(nearest_corner(graph, foot));
    GeodesicLimits limits;
    limits.distance = half_width;
    search.run(along, limits);
    region.insert(search.reached());
    return region;
}

} // namespace

OutlineAreaRules outline_area_rules(double unit_mm) {
    OutlineAreaRules rules;
    for (double* length : {&rules.mean_far, &rules.far, &rules.open_gap, &rules.strip})
        *length /= unit_mm;
    return rules;
}

SurfaceRegion area_from_outline(GeodesicSearch& bone, const Points& outline, const OutlineAreaRules& rules,
                                const std::string& who) {
    const std::vector<SurfacePoint> feet = feet_of(bone.graph(), outline, rules, who);
    const bool open = outline.size() < 3 || (outline.front() - outline.back()).norm() > rules.open_gap;
    const bool closed = !open && feet.size() >= 3;
    const std::vector<GeodesicLine> lines = lines_between(bone, feet, closed, who);
    if (closed) {
        bool cuts = false;
        const int start = bone.graph().triangle(feet[0].triangle)[0];
        SurfaceRegion region = enclosed(bone.graph(), lines, start, cuts);
        if (cuts)
            return region;
    }
    return strip_along(bone, feet, lines, 0.5 * rules.strip);
}

} // namespace fascicle
