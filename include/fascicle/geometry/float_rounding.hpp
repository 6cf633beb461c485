#pragma once
// Numbers as they come back from floats, in doubles.

#include "fascicle/base/types.hpp"

namespace fascicle {

/// The float nearest to x (ties to even), as a double; beyond the range of floats infinite, NaN stays NaN. Never written out as two
/// conversions in one expression: g++ 12 leaves the rounding out where it makes vectors of neighbouring ones
/// (tools/check_float_rounding.py finds them).
double rounded_to_float(double x);
/// The same for each coordinate.
void round_to_floats(Points& points);

} // namespace fascicle
