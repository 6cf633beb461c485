#include "fascicle/base/assert.hpp"
#include "fascicle/geometry/bvh.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle {
namespace {

constexpr std::size_t stack_size = 64; // see bvh.cpp

/// Moeller & Trumbore 1997: solves origin + t direction = (1 - u - v) a + u b + v c. Infinity when it misses.
double ray_triangle(const Vec3& origin, const Vec3& direction, const Vec3& a, const Vec3& b, const Vec3& c) {
    constexpr double missed = std::numeric_limits<double>::infinity();
    const Vec3 e1 = b - a, e2 = c - a;
    const Vec3 p = direction.cross(e2);
    const double determinant = e1.dot(p);
    if (!(std::abs(determinant) > 1e-12 * e1.norm() * e2.norm() * direction.norm()))
        return missed;
    const Vec3 s = origin - a;
    const double u = s.dot(p) / determinant;
    if (!(u >= 0 && u <= 1))
        return missed;
    const Vec3 q = s.cross(e1);
    const double v = direction.dot(q) / determinant;
    return v >= 0 && u + v <= 1 ? e2.dot(q) / determinant : missed;
}

} // namespace

RayHit TriangleBvh::trace(const Vec3& origin, const Vec3& direction, double from, double to, bool any) const {
    RayHit best{-1, to};
    if (nodes_.empty() || !origin.allFinite() || !direction.allFinite())
        return {};
    const Vec3 inverse = direction.cwiseInverse(); // infinite along an axis that the ray does not move on
    std::array<int, stack_size> stack;
    std::size_t depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
        const int child = stack[--depth];
        if (child >= 0) {
            const Node& node = nodes_[static_cast<std::size_t>(child)];
            for (std::size_t i = 0; i < 4; ++i) {
                if (!(node.low[0][i] <= node.high[0][i]))
                    continue; // absent
                double enter = from, leave = best.distance;
                for (std::size_t k = 0; k < 3; ++k) {
                    const auto axis = static_cast<Eigen::Index>(k);
                    if (direction[axis] == 0.0) {
                        if (origin[axis] < node.low[k][i] || origin[axis] > node.high[k][i])
                            enter = std::numeric_limits<double>::infinity();
                        continue;
                    }
                    const double t0 = (node.low[k][i] - origin[axis]) * inverse[axis];
                    const double t1 = (node.high[k][i] - origin[axis]) * inverse[axis];
                    enter = std::max(enter, std::min(t0, t1));
                    leave = std::min(leave, std::max(t0, t1));
                }
                // A hair wider than exact, for the rounding of the quotients.
                if (!(enter <= leave + 1e-12 * (std::abs(enter) + std::abs(leave))))
                    continue;
                FASCICLE_ASSERT(depth < stack_size);
                stack[depth++] = node.child[i];
            }
            continue;
        }
        const auto leaf = static_cast<std::size_t>(~child);
        for (std::size_t lane = 0; lane < 4; ++lane) {
            const auto corner = [&](std::size_t i) {
                const auto& c = leaves_[leaf].corners[i];
                return Vec3(c[0][lane], c[1][lane], c[2][lane]);
            };
            const double t = ray_triangle(origin, direction, corner(0), corner(1), corner(2));
            const int triangle = triangle_of_[4 * leaf + lane];
            if (!(t > from && t < to) || t > best.distance ||
                (t == best.distance && best.triangle >= 0 && triangle >= best.triangle))
                continue;
            best = {triangle, t};
            if (any)
                return best;
        }
    }
    return best.triangle < 0 ? RayHit{} : best;
}

RayHit TriangleBvh::ray_hit(const Vec3& origin, const Vec3& direction, double from, double to) const {
    return trace(origin, direction, from, to, false);
}

bool TriangleBvh::blocked(const Vec3& origin, const Vec3& direction, double from, double to) const {
    return trace(origin, direction, from, to, true).triangle >= 0;
}

} // namespace fascicle
