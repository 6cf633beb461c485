#include "fascicle/metrics/percentile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fascicle {

void percentiles(std::span<double> values, std::span<const double> percents, std::vector<double>& result) {
    result.assign(percents.size(), std::numeric_limits<double>::quiet_NaN());
    if (values.empty())
        return;
    for (double& v : values)
        if (!std::isfinite(v)) // a NaN has no place in an order
            v = std::numeric_limits<double>::infinity();
    // Ascending percents: each selection only has to look at what is above the previous one.
    auto settled = values.begin();
    for (std::size_t i = 0; i < percents.size(); ++i) {
        const double x = percents[i] / 100.0 * static_cast<double>(values.size() - 1);
        const auto below = static_cast<std::ptrdiff_t>(x);
        const double share = x - static_cast<double>(below);
        const auto at = values.begin() + below;
        if (at >= settled)
            std::nth_element(settled, at, values.end());
        settled = std::max(settled, at);
        result[i] = *at;
        if (share > 0.0)
            result[i] += share * (*std::min_element(at + 1, values.end()) - *at);
    }
}

} // namespace fascicle
