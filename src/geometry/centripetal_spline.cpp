#include "fascicle/geometry/centripetal_spline.hpp"

#include "fascicle/base/assert.hpp"

#include <cmath>

namespace fascicle {

std::vector<double> centripetal_knots(std::span<const Vec3> points) {
    std::vector<double> knots(points.size(), 0.0);
    for (std::size_t i = 1; i < points.size(); ++i)
        knots[i] = knots[i - 1] + std::sqrt((points[i] - points[i - 1]).norm());
    return knots;
}

CentripetalSpline::CentripetalSpline(Points points) : points_(std::move(points)) {
    FASCICLE_ASSERT(!points_.empty());
    knots_ = centripetal_knots(points_);
    find_tangents();
}

CentripetalSpline::CentripetalSpline(Points points, std::vector<double> knots)
    : points_(std::move(points)), knots_(std::move(knots)) {
    FASCICLE_ASSERT(!points_.empty() && points_.size() == knots_.size());
    find_tangents();
}

void CentripetalSpline::find_tangents() {
    const std::size_t n = points_.size();
    tangents_.assign(n, Vec3::Zero());
    for (std::size_t i = 0; i < n; ++i) {
        const double before = i > 0 ? knots_[i] - knots_[i - 1] : 0.0;
        const double after = i + 1 < n ? knots_[i + 1] - knots_[i] : 0.0;
        // Mirroring the other neighbour makes the three terms collapse into the slope towards it.
        if (before > 0.0 && after > 0.0)
            tangents_[i] = (points_[i] - points_[i - 1]) / before -
                           (points_[i + 1] - points_[i - 1]) / (before + after) +
                           (points_[i + 1] - points_[i]) / after;
        else if (after > 0.0)
            tangents_[i] = (points_[i + 1] - points_[i]) / after;
        else if (before > 0.0)
            tangents_[i] = (points_[i] - points_[i - 1]) / before;
    }
}

Vec3 CentripetalSpline::at(int span, double share) const {
    FASCICLE_ASSERT(span >= 0 && span < spans());
    const auto i = static_cast<std::size_t>(span);
    const double length = knots_[i + 1] - knots_[i];
    if (share <= 0.0 || length <= 0.0)
        return points_[i];
    if (share >= 1.0)
        return points_[i + 1];
    // Cubic Hermite form.
    const double s = share, r = 1.0 - share;
    return r * r * (1.0 + 2.0 * s) * points_[i] + s * s * (1.0 + 2.0 * r) * points_[i + 1] +
           length * s * r * (r * tangents_[i] - s * tangents_[i + 1]);
}

} // namespace fascicle
