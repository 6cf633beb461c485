#include "fascicle/metrics/edge_extension.hpp"

#include "fascicle/metrics/percentile.hpp"

#include <limits>

namespace fascicle {

namespace {

double length(const Edge& e, const Points& points) {
    return (points[static_cast<std::size_t>(e.b)] - points[static_cast<std::size_t>(e.a)]).norm();
}

} // namespace

EdgeExtensionMeasure::EdgeExtensionMeasure(const std::vector<Edge>& edges, const Points& rest) {
    for (const Edge& e : edges)
        if (const double l = length(e, rest); l > 0.0) {
            edges_.push_back(e);
            rest_lengths_.push_back(l);
        }
    ratios_.resize(edges_.size());
}

EdgeExtension EdgeExtensionMeasure::measure(const Points& points) {
    constexpr std::array<double, 8> percents{1, 10, 25, 50, 75, 90, 99, 100};
    double sum = 0.0;
    for (std::size_t i = 0; i < edges_.size(); ++i) {
        ratios_[i] = length(edges_[i], points) / rest_lengths_[i];
        sum += ratios_[i];
    }
    percentiles(ratios_, percents, percentiles_);
    const double mean =
        edges_.empty() ? std::numeric_limits<double>::quiet_NaN() : sum / static_cast<double>(edges_.size());
    const auto& p = percentiles_;
    return {mean, p[0], p[1], p[2], p[3], p[4], p[5], p[6], p[7]};
}

std::vector<double> EdgeExtensionMeasure::at_vertices(const Points& points) const {
    std::vector<double> mean(points.size(), 0.0);
    std::vector<int> count(points.size(), 0);
    for (std::size_t i = 0; i < edges_.size(); ++i)
        for (const int v : {edges_[i].a, edges_[i].b}) {
            mean[static_cast<std::size_t>(v)] += length(edges_[i], points) / rest_lengths_[i];
            ++count[static_cast<std::size_t>(v)];
        }
    for (std::size_t v = 0; v < mean.size(); ++v)
        mean[v] = count[v] > 0 ? mean[v] / count[v] : 1.0;
    return mean;
}

} // namespace fascicle
