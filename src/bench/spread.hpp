#pragma once
// Median, least and greatest of repeated measurements.

#include <vector>

namespace fascicle::bench {

struct Spread {
    double median = 0;
    double min = 0;
    double max = 0;
    int runs = 0; ///< 0: nothing was measured, the rest is 0

    /// Whether the figures lie too far apart to be trusted: (max - min) / median > undecided_spread.
    bool undecided() const;
};

/// A fifth: on a quiet machine runs lie within a few percent; a second program on the same core shows as more.
inline constexpr double undecided_spread = 0.2;

Spread spread_of(std::vector<double> values);

/// The spread of factor / value: rates from times. Values must not be 0.
Spread spread_of_rates(double factor, const std::vector<double>& values);

} // namespace fascicle::bench
