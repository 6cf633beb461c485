#include "fascicle/anatomy/inside_hold.hpp"

#include "fascicle/base/bytes_of.hpp"
#include "fascicle/geometry/closest_point.hpp"

#include <cmath>
#include <limits>

namespace fascicle {

InsideHold::InsideHold(const TriMesh& surface, const MeshTopology& topology) : triangles_(surface.triangles) {
    fan_starts_.push_back(0);
    for (int v = 0; v < surface.vertex_count(); ++v) {
        for (const int t : topology.vertex_triangles(v))
            fans_.push_back(t);
        fan_starts_.push_back(static_cast<std::uint32_t>(fans_.size()));
    }
}

void InsideHold::reserve(std::size_t points) {
    ends_.reserve(points);
    margins_.reserve(points);
}

void InsideHold::add(const std::array<std::int32_t, ends_per_point>& ends, double margin) {
    ends_.push_back(ends);
    margins_.push_back(margin);
}

std::size_t InsideHold::bytes() const {
    return bytes_of(ends_, margins_, triangles_, fan_starts_, fans_);
}

int InsideHold::walk_down(int start, const Vec3& x, std::span<const Vec3> surface) const {
    const auto squared = [&](int v) { return (surface[static_cast<std::size_t>(v)] - x).squaredNorm(); };
    int nearest = start;
    double best = squared(start);
    for (int from = -1; from != nearest;) { // ends: the distance falls with every step
        from = nearest;
        const auto v = static_cast<std::size_t>(from);
        for (std::uint32_t k = fan_starts_[v]; k < fan_starts_[v + 1]; ++k)
            for (const int w : triangles_[static_cast<std::size_t>(fans_[k])])
                if (const double d = squared(w); d < best) {
                    best = d;
                    nearest = w;
                }
    }
    return nearest;
}

/// The nearest place on the triangles around a vertex, and the outward side of the surface there: the sum of the normals
/// of the triangles that have it in common, weighted by their angles at a vertex (Baerentzen & Aanaes 2005).
InsideHold::Foot InsideHold::foot_around(int vertex, const Vec3& x, std::span<const Vec3> surface) const {
    Foot foot;
    const auto v = static_cast<std::size_t>(vertex);
    const Vec3& a = surface[v];
    for (std::uint32_t k = fan_starts_[v]; k < fan_starts_[v + 1]; ++k) {
        const Tri& t = triangles_[static_cast<std::size_t>(fans_[k])];
        const std::size_t corner = t[0] == vertex ? 0 : t[1] == vertex ? 1 : 2;
        const Vec3& b = surface[static_cast<std::size_t>(t[(corner + 1) % 3])];
        const Vec3& c = surface[static_cast<std::size_t>(t[(corner + 2) % 3])];
        const Vec3 n = (b - a).cross(c - a);
        const double length = n.norm();
        if (!(length > 0))
            continue;
        const TrianglePoint q = closest_point_on_triangle(x, a, b, c);
        const double angle = q.weights[0] > 1.0 - 1e-9 ? std::atan2(length, (b - a).dot(c - a)) : 1.0;
        if ((q.point - foot.point).squaredNorm() <= 1e-20 * (a - b).squaredNorm() &&
            std::isfinite(foot.squared_distance))
            foot.normal += angle / length * n;
        else if (q.squared_distance < foot.squared_distance)
            foot = {q.point, angle / length * n, q.squared_distance};
    }
    return foot;
}

Vec3 InsideHold::moved_in(std::size_t point, const Vec3& x, std::span<const Vec3> surface) const {
    // One walk from the nearest vertex known, one from the nearest on a side that x seems to be beyond: where the
    // muscle is dented deeply the side that passed over the point need not be the nearest.
    int start = -1, start_beyond = -1;
    double best = std::numeric_limits<double>::infinity(), best_beyond = best;
    for (const std::int32_t t : ends_[point]) {
        if (t < 0)
            break;
        const bool over = beyond(t, x, surface);
        for (const int v : triangles_[static_cast<std::size_t>(t)]) {
            const double d = (surface[static_cast<std::size_t>(v)] - x).squaredNorm();
            if (d < best) {
                best = d;
                start = v;
            }
            if (over && d < best_beyond) {
                best_beyond = d;
                start_beyond = v;
            }
        }
    }
    if (start < 0) // a surface that is not finite
        return x;
    Foot foot = foot_around(walk_down(start, x, surface), x, surface);
    if (start_beyond >= 0 && start_beyond != start) {
        const Foot other = foot_around(walk_down(start_beyond, x, surface), x, surface);
        if (other.squared_distance < foot.squared_distance)
            foot = other;
    }
    if (!std::isfinite(foot.squared_distance) || !((x - foot.point).dot(foot.normal) > 0))
        return x;
    return foot.point - margins_[point] * foot.normal.normalized();
}

} // namespace fascicle
