#include "view/vertex_extension.hpp"

#include "fascicle/base/assert.hpp"

namespace fascicle::view {

std::vector<double> vertex_extension(const MeshTopology& topology, const Points& rest, const Points& points) {
    FASCICLE_ASSERT(rest.size() == points.size() &&
                    rest.size() == static_cast<std::size_t>(topology.vertex_count()));
    std::vector<double> sums(points.size(), 0.0);
    std::vector<int> counts(points.size(), 0);
    for (const Edge& edge : topology.edges()) {
        const auto a = static_cast<std::size_t>(edge.a), b = static_cast<std::size_t>(edge.b);
        const double rest_length = (rest[b] - rest[a]).norm();
        if (!(rest_length > 0))
            continue;
        const double extension = (points[b] - points[a]).norm() / rest_length;
        for (const std::size_t vertex : {a, b}) {
            sums[vertex] += extension;
            ++counts[vertex];
        }
    }
    for (std::size_t i = 0; i < sums.size(); ++i)
        sums[i] = counts[i] > 0 ? sums[i] / counts[i] : 1.0;
    return sums;
}

} // namespace fascicle::view
