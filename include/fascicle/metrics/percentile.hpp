#pragma once
// Order statistics of a list of numbers.

#include <span>
#include <vector>

namespace fascicle {

/// The percentiles `percents` (each in [0, 100], ascending) of n values, with linear interpolation between
/// order statistics: x = p / 100 (n - 1), result = v[floor x] + (x - floor x) (v[floor x + 1] - v[floor x])
/// for sorted v from v[0] (Hyndman & Fan 1996, type 7); so p = 0 is the minimum, 100 the maximum, 50 the
/// median. Values are reordered; non-finite ones count as +infinity. No values: every percentile is NaN.
/// result: one entry per percent, not reallocated when it has that size already.
void percentiles(std::span<double> values, std::span<const double> percents, std::vector<double>& result);

} // namespace fascicle
