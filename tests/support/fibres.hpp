#pragma once
// Fibre sets whose measures are known, for tests.

#include "fascicle/anatomy/fibre_set.hpp"

#include <utility>

namespace fascicle::test {

/// Straight fibres from the first to the second point of each pair, cut into equal segments.
inline FibreSet straight_fibres(const std::vector<std::pair<Vec3, Vec3>>& ends, int segments = 1) {
    FibreSet fibres;
    fibres.count = static_cast<int>(ends.size());
    fibres.segments = segments;
    for (const auto& [origin, insertion] : ends)
        for (int j = 0; j <= segments; ++j)
            fibres.points.push_back(origin + (insertion - origin) * (double(j) / segments));
    return fibres;
}

/// One fibre through these points.
inline FibreSet one_fibre(Points points) {
    return {1, static_cast<int>(points.size()) - 1, std::move(points)};
}

} // namespace fascicle::test
