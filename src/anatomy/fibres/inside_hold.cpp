#include "fascicle/anatomy/inside_hold.hpp"

#include "fascicle/base/bytes_of.hpp"
#include "fascicle/geometry/closest_point.hpp"

#include <cmath>
#include <limits>

namespace fascicle {

InsideHold::InsideHold(const TriMesh& surface, const MeshTopology& topology)
    : triangles_(surface.triangles) {
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

Vec3 InsideHold::moved_in(std::size_t point, const Vec3& x, std::span<const Vec3> surface) const {
    const auto squared = [&](int v) { return (surface[static_cast<std::size_t>(v)] - x).squaredNorm(); };
    int nearest = -1;
    double best = std::numeric_limits<double>::infinity();
    const auto consider = [&](int v) {
        if (const double d = squared(v); d < best) {
            best = d;
            nearest = v;
        }
    };
    for (const std::int32_t t : ends_[point])
        if (t >= 0)
            for (const int v : triangles_[static_cast<std::size_t>(t)])
                consider(v);
    if (nearest < 0) // a surface that is not finite
        return x;
    for (int from = -1; from != nearest;) { // ends: the distance falls with every step
        from = nearest;
        const auto v = static_cast<std::size_t>(from);
        for (std::uint32_t k = fan_starts_[v]; k < fan_starts_[v + 1]; ++k)
            for (const int w : triangles_[static_cast<std::size_t>(fans_[k])])
                consider(w);
    }
    // The nearest place on the triangles around, and the outward side of the surface there: the sum of the normals of
    // the triangles that have it in common, weighted by their angles at a vertex (Baerentzen & Aanaes 2005).
    TrianglePoint foot;
    foot.squared_distance = std::numeric_limits<double>::infinity();
    Vec3 normal = Vec3::Zero();
    const auto v = static_cast<std::size_t>(nearest);
    for (std::uint32_t k = fan_starts_[v]; k < fan_starts_[v + 1]; ++k) {
        const Tri& t = triangles_[static_cast<std::size_t>(fans_[k])];
        const std::size_t corner = t[0] == nearest ? 0 : t[1] == nearest ? 1 : 2;
        const Vec3& a = surface[v];
        const Vec3& b = surface[static_cast<std::size_t>(t[(corner + 1) % 3])];
        const Vec3& c = surface[static_cast<std::size_t>(t[(corner + 2) % 3])];
        const Vec3 n = (b - a).cross(c - a);
        const double length = n.norm();
        if (!(length > 0))
            continue;
        const TrianglePoint q = closest_point_on_triangle(x, a, b, c);
        const bool same = (q.point - foot.point).squaredNorm() <= 1e-20 * (a - b).squaredNorm();
        const double angle = q.weights[0] > 1.0 - 1e-9 ? std::atan2(length, (b - a).dot(c - a)) : 1.0;
        if (same && std::isfinite(foot.squared_distance))
            normal += angle / length * n;
        else if (q.squared_distance < foot.squared_distance) {
            foot = q;
            normal = angle / length * n;
        }
    }
    if (!std::isfinite(foot.squared_distance) || !((x - foot.point).dot(normal) > 0))
        return x;
    return foot.point - margins_[point] * normal.normalized();
}

} // namespace fascicle
