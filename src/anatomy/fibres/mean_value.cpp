#include "anatomy/fibres/mean_value.hpp"

#include "fascicle/base/assert.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle {

void mean_value_weights(std::span<const Vec2> polygon, const Vec2& x, std::span<double> weights) {
    const std::size_t m = polygon.size();
    FASCICLE_ASSERT(m >= 3 && weights.size() == m);
    std::fill(weights.begin(), weights.end(), 0.0);
    double size = 0;
    for (const Vec2& v : polygon)
        size = std::max(size, (v - polygon[0]).cwiseAbs().maxCoeff());
    if (!(size > 0)) {
        std::fill(weights.begin(), weights.end(), 1.0 / double(m));
        return;
    }
    const double tiny = 1e-9 * size;
    for (std::size_t i = 0; i < m; ++i)
        if ((polygon[i] - x).norm() <= tiny) {
            weights[i] = 1.0;
            return;
        }
    for (std::size_t i = 0; i < m; ++i) {
        const std::size_t j = (i + 1) % m;
        const Vec2 edge = polygon[j] - polygon[i], s = x - polygon[i];
        const double length = edge.norm();
        if (!(length > 0))
            continue;
        const double along = s.dot(edge) / length, across = edge.x() * s.y() - edge.y() * s.x();
        if (std::abs(across) <= tiny * length && along >= 0 && along <= length) {
            weights[j] = along / length;
            weights[i] = 1.0 - weights[j];
            return;
        }
    }
    // tan(angle / 2) = (r_i r_i+1 - D_i) / (2 A_i): the same w_i = (tan_i-1 + tan_i) / r_i up to a common factor.
    double sum = 0, before = 0;
    for (std::size_t k = 0; k <= m; ++k) {
        const std::size_t i = k % m;
        const Vec2 a = polygon[i] - x, b = polygon[(i + 1) % m] - x;
        const double cross = a.x() * b.y() - a.y() * b.x(), dot = a.dot(b);
        const double lengths = a.norm() * b.norm();
        // Off the polygon cross vanishes only for a zero edge or one seen end on: no angle.
        const double half_tangent = dot > 0      ? cross / (lengths + dot)
                                    : cross == 0 ? 0
                                                 : (lengths - dot) / cross;
        if (k > 0) {
            weights[i] = (before + half_tangent) / a.norm();
            sum += weights[i];
        }
        before = half_tangent;
    }
    for (double& w : weights)
        w /= sum;
}

} // namespace fascicle
