#include "curve_tools.hpp"

#include <algorithm>
#include <vector>

namespace fascicle::chmd {

namespace {

std::vector<double> arc_positions(std::span<const Vec3> line) {
    std::vector<double> arc(line.size(), 0.0);
    for (std::size_t i = 1; i < line.size(); ++i)
        arc[i] = arc[i - 1] + (line[i] - line[i - 1]).norm();
    return arc;
}

Vec3 at_arc(std::span<const Vec3> line, const std::vector<double>& arc, double s) {
    const auto next = std::upper_bound(arc.begin(), arc.end(), s);
    if (next == arc.begin())
        return line.front();
    if (next == arc.end())
        return line.back();
    const auto i = static_cast<std::size_t>(next - arc.begin()) - 1;
    return line[i] + (s - arc[i]) / (arc[i + 1] - arc[i]) * (line[i + 1] - line[i]);
}

} // namespace

double polyline_length(std::span<const Vec3> line) {
    double length = 0;
    for (std::size_t i = 1; i < line.size(); ++i)
        length += (line[i] - line[i - 1]).norm();
    return length;
}

Vec3 point_at_share(std::span<const Vec3> line, double share) {
    const std::vector<double> arc = arc_positions(line);
    return at_arc(line, arc, share * arc.back());
}

Points equal_arcs(std::span<const Vec3> line, int segments) {
    const std::vector<double> arc = arc_positions(line);
    Points points(static_cast<std::size_t>(segments) + 1, line.front());
    for (std::size_t k = 1; k + 1 < points.size(); ++k)
        points[k] = at_arc(line, arc, arc.back() * static_cast<double>(k) / segments);
    points.back() = line.back();
    return points;
}

Points smooth_line(Points points, int pieces) {
    const CentripetalSpline spline(std::move(points));
    Points line{spline.points().front()};
    for (int span = 0; span < spline.spans(); ++span)
        for (int k = 1; k <= pieces; ++k)
            line.push_back(spline.at(span, static_cast<double>(k) / pieces));
    return line;
}

Points part_of_line(std::span<const Vec3> line, double from, double to) {
    const std::vector<double> arc = arc_positions(line);
    const double begin = from * arc.back(), end = to * arc.back();
    const double close = 1e-6 * arc.back();
    Points part{at_arc(line, arc, begin)};
    for (std::size_t i = 0; i < line.size(); ++i)
        if (arc[i] > begin + close && arc[i] < end - close)
            part.push_back(line[i]);
    part.push_back(at_arc(line, arc, end));
    return part;
}

} // namespace fascicle::chmd
