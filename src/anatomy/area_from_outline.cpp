#include "fascicle/anatomy/area_from_outline.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/geometry/line_region.hpp"

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
    if (closed)
        if (const auto region = enclosed_by_lines(bone.graph(), lines))
            return *region;
    return strip_along_lines(bone, feet, lines, 0.5 * rules.strip);
}

} // namespace fascicle
