#include "fascicle/geometry/closest_point.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace fascicle {

double closest_share_on_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 d = b - a;
    const double dd = d.squaredNorm();
    if (!(dd > 0.0))
        return 0.0;
    return std::clamp((p - a).dot(d) / dd, 0.0, 1.0);
}

TrianglePoint closest_point_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 ab = b - a, ac = c - a, bc = c - b;
    const Vec3 ap = p - a, bp = p - b;
    const Vec3 normal = ab.cross(ac);
    const double nn = normal.squaredNorm();
    const double longest = std::max({ab.squaredNorm(), ac.squaredNorm(), bc.squaredNorm()});
    // Signed areas (times 2|N|) of the parts opposite to each corner: their signs tell which edges p sees.
    double part_a = -1.0, part_b = -1.0, part_c = -1.0;
    if (nn > 1e-24 * longest * longest) {
        part_a = bc.cross(bp).dot(normal);
        part_b = ap.cross(ac).dot(normal);
        part_c = ab.cross(ap).dot(normal);
    }
    TrianglePoint best;
    if (part_a >= 0.0 && part_b >= 0.0 && part_c >= 0.0) {
        best.weights = Vec3(part_a, part_b, part_c) / (part_a + part_b + part_c);
        const double height = ap.dot(normal);
        best.squared_distance = height * height / nn;
        best.point = p - normal * (height / nn);
        return best;
    }
    best.squared_distance = std::numeric_limits<double>::infinity();
    const auto try_edge = [&](const Vec3& u, const Vec3& v, int iu, int iv) {
        const double t = closest_share_on_segment(p, u, v);
        const Vec3 q = u + t * (v - u);
        const double d2 = (p - q).squaredNorm();
        if (d2 < best.squared_distance) {
            best.squared_distance = d2;
            best.point = q;
            best.weights.setZero();
            best.weights[iu] = 1.0 - t;
            best.weights[iv] = t;
        }
    };
    if (part_a < 0.0)
        try_edge(b, c, 1, 2);
    if (part_b < 0.0)
        try_edge(a, c, 0, 2);
    if (part_c < 0.0)
        try_edge(a, b, 0, 1);
    return best;
}

} // namespace fascicle
