#include "fascicle/geometry/vertex_normals.hpp"

#include "fascicle/base/assert.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace fascicle {

Points vertex_normals(const Points& points, const std::vector<Tri>& triangles) {
    Points normals(points.size(), Vec3::Zero());
    for (const Tri& triangle : triangles) {
        std::array<std::size_t, 3> at{};
        for (std::size_t k = 0; k < 3; ++k) {
            at[k] = static_cast<std::size_t>(triangle[k]);
            FASCICLE_ASSERT(triangle[k] >= 0 && at[k] < points.size());
        }
        const Vec3 doubled_area = (points[at[1]] - points[at[0]]).cross(points[at[2]] - points[at[0]]);
        const double size = doubled_area.norm();
        if (!(size > 0))
            continue;
        const Vec3 normal = doubled_area / size;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 a = points[at[(k + 1) % 3]] - points[at[k]];
            const Vec3 b = points[at[(k + 2) % 3]] - points[at[k]];
            // |a x b| is the doubled area at every corner; atan2 is exact near 0 and pi where acos is not.
            normals[at[k]] += std::atan2(size, a.dot(b)) * normal;
        }
    }
    for (Vec3& normal : normals) {
        const double size = normal.norm();
        normal = size > 1e-12 ? Vec3(normal / size) : Vec3(Vec3::Zero()); // angles add up to about 2 pi
    }
    return normals;
}

} // namespace fascicle
