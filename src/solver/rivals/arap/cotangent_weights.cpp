#include "solver/rivals/arap/cotangent_weights.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace fascicle::solver {

double bounded_cotangent(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 u = a - c, v = b - c;
    const double along = u.dot(v), across = u.cross(v).norm();
    if (std::abs(along) >= most_cotangent * across) // also where there is no area
        return along == 0.0 ? 0.0 : std::copysign(most_cotangent, along);
    return along / across;
}

std::vector<double> cotangent_weights(const Points& rest, const std::vector<Tri>& triangles,
                                      const MeshTopology& topology) {
    std::vector<double> weights(topology.edges().size(), 0.0);
    for (std::size_t e = 0; e < weights.size(); ++e) {
        for (const int half_edge : topology.edge_half_edges(static_cast<int>(e))) {
            const Tri& t = triangles[static_cast<std::size_t>(half_edge / 3)];
            const auto at = [&](int corner) {
                return rest[static_cast<std::size_t>(t[static_cast<std::size_t>(corner % 3)])];
            };
            const int corner = half_edge % 3;
            weights[e] += 0.5 * bounded_cotangent(at(corner), at(corner + 1), at(corner + 2));
        }
        weights[e] = std::max(weights[e], least_weight);
    }
    return weights;
}

} // namespace fascicle::solver
