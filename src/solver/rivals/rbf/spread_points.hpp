#pragma once
// A few of many points, evenly spread: farthest point sampling (Gonzalez 1985).

#include "fascicle/base/types.hpp"

#include <algorithm>
#include <limits>
#include <span>

namespace fascicle::solver {

/// Adds to `chosen` those of `candidates` (indices of points) that are farthest from all chosen before, one by one, until it holds
/// `most` or none is farther than `apart`. The first candidate is taken when nothing is chosen yet. Of equals, the earlier candidate.
inline void spread_points(const Points& points, std::span<const int> candidates, std::size_t most,
                          double apart, std::vector<int>& chosen) {
    std::vector<double> nearest(candidates.size(), std::numeric_limits<double>::infinity());
    const auto take = [&](int point) {
        for (std::size_t k = 0; k < candidates.size(); ++k)
            nearest[k] = std::min(nearest[k], (points[static_cast<std::size_t>(candidates[k])] -
                                               points[static_cast<std::size_t>(point)])
                                                  .squaredNorm());
    };
    for (const int point : chosen)
        take(point);
    while (chosen.size() < most && !candidates.empty()) {
        const auto k =
            static_cast<std::size_t>(std::max_element(nearest.begin(), nearest.end()) - nearest.begin());
        if (!(nearest[k] > apart * apart))
            return;
        chosen.push_back(candidates[k]);
        take(candidates[k]);
    }
}

} // namespace fascicle::solver
