#include "bench/spread.hpp"

#include <algorithm>

namespace fascicle::bench {

bool Spread::undecided() const {
    return max - min > undecided_spread * median;
}

Spread spread_of(std::vector<double> values) {
    if (values.empty())
        return {};
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    return {0.5 * (values[(n - 1) / 2] + values[n / 2]), values.front(), values.back(), static_cast<int>(n)};
}

Spread spread_of_rates(double factor, const std::vector<double>& values) {
    std::vector<double> rates;
    for (const double value : values)
        rates.push_back(factor / value);
    return spread_of(std::move(rates));
}

} // namespace fascicle::bench
