#include "fascicle/metrics/rest_distance.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle {

RestDistanceMeasure::RestDistanceMeasure(const std::vector<Tri>& triangles, Points rest)
    : rest_(std::move(rest)), rest_tree_(rest_, triangles), now_tree_(rest_tree_),
      triangle_of_(rest_.size(), -1) {
    for (std::size_t t = triangles.size(); t-- > 0;)
        for (const int v : triangles[t])
            triangle_of_[static_cast<std::size_t>(v)] = static_cast<int>(t);
    for (std::size_t v = 0; v < rest_.size(); ++v)
        if (triangle_of_[v] >= 0)
            used_.push_back(static_cast<int>(v));
}

double RestDistanceMeasure::one_sided(const Points& from, const TriangleBvh& to, double known) {
    // Largest first: a vertex whose displacement is not above what is known already cannot raise it (Taha &
    // Hanbury 2015 prune alike), nor can one with any triangle within that distance.
    for (const auto& [displacement, v] : by_displacement_) {
        if (displacement <= known)
            break;
        int hint = triangle_of_[static_cast<std::size_t>(v)];
        const double d2 = to.closest_squared_distance(from[static_cast<std::size_t>(v)],
                                                      std::numeric_limits<double>::infinity(), hint, known);
        known = std::max(known, std::sqrt(d2));
    }
    return known;
}

RestDistance RestDistanceMeasure::measure(const Points& points) {
    RestDistance result;
    if (used_.empty())
        return result;
    by_displacement_.clear();
    double sum = 0.0, squares = 0.0;
    for (const int v : used_) {
        const double d2 =
            (points[static_cast<std::size_t>(v)] - rest_[static_cast<std::size_t>(v)]).squaredNorm();
        const double d = std::isfinite(d2) ? std::sqrt(d2) : std::numeric_limits<double>::infinity();
        sum += d;
        squares += d * d;
        by_displacement_.emplace_back(d, v);
    }
    const auto count = static_cast<double>(used_.size());
    result.mean = sum / count;
    result.rms = std::sqrt(squares / count);
    result.max = std::max_element(by_displacement_.begin(), by_displacement_.end())->first;
    if (!std::isfinite(result.max)) {
        result.hausdorff = result.max;
        return result;
    }
    if (result.max == 0.0)
        return result;
    std::sort(by_displacement_.begin(), by_displacement_.end(), std::greater<>());
    now_tree_.refit(points);
    result.hausdorff = one_sided(points, rest_tree_, 0.0);
    result.hausdorff = one_sided(rest_, now_tree_, result.hausdorff);
    return result;
}

} // namespace fascicle
