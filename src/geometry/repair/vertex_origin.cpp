#include "fascicle/geometry/repair/vertex_origin.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle {

VertexOrigin mean_origin(const std::vector<VertexOrigin>& origins, const std::vector<double>& weights) {
    std::vector<std::pair<int, double>> parts;
    for (std::size_t i = 0; i < origins.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
            if (origins[i].vertices[k] >= 0)
                parts.emplace_back(origins[i].vertices[k], weights[i] * origins[i].weights[k]);
    std::sort(parts.begin(), parts.end());
    std::size_t kept = 0;
    for (std::size_t i = 0; i < parts.size(); ++i)
        if (kept > 0 && parts[kept - 1].first == parts[i].first)
            parts[kept - 1].second += parts[i].second;
        else
            parts[kept++] = parts[i];
    parts.resize(kept);
    std::stable_sort(parts.begin(), parts.end(),
                     [](const auto& a, const auto& b) { return a.second > b.second; });
    parts.resize(std::min<std::size_t>(parts.size(), 3));
    double sum = 0;
    for (const auto& part : parts)
        sum += part.second;
    VertexOrigin mean;
    for (std::size_t k = 0; k < parts.size(); ++k) {
        mean.vertices[k] = parts[k].first;
        mean.weights[k] = sum > 0 ? parts[k].second / sum : (k == 0 ? 1 : 0);
    }
    return mean;
}

std::vector<double> carried_values(const std::vector<VertexOrigin>& origins,
                                   const std::vector<double>& values, std::size_t width) {
    const bool labels =
        std::all_of(values.begin(), values.end(), [](double v) { return std::nearbyint(v) == v; });
    std::vector<double> out(origins.size() * width, 0);
    for (std::size_t v = 0; v < origins.size(); ++v) {
        const std::size_t parts = labels ? 1 : 3;
        for (std::size_t k = 0; k < parts; ++k) {
            const int from = origins[v].vertices[k];
            const double weight = labels ? 1 : origins[v].weights[k];
            if (from < 0 || weight == 0)
                continue; // weight 0: a value that is not finite must not spread
            for (std::size_t c = 0; c < width; ++c)
                out[v * width + c] += weight * values[static_cast<std::size_t>(from) * width + c];
        }
    }
    return out;
}

std::vector<int> carried_members(const std::vector<VertexOrigin>& origins, const std::vector<int>& members) {
    std::vector<int> out;
    for (std::size_t v = 0; v < origins.size(); ++v)
        if (const int from = origins[v].nearest();
            from >= 0 && std::binary_search(members.begin(), members.end(), from))
            out.push_back(static_cast<int>(v));
    return out;
}

} // namespace fascicle
