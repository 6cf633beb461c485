#pragma once
// Mean value coordinates in a plane.

#include "fascicle/base/types.hpp"

#include <span>

namespace fascicle {

/// Weights (m, sum 1) of the corners of a closed polygon of m >= 3 points, either way round, at x (Hormann & Floater 2006):
/// with s_i = v_i - x, r_i = |s_i|, A_i = (s_i x s_i+1) / 2, D_i = s_i . s_i+1,
///   w_i = (r_i-1 - D_i-1 / r_i) / A_i-1 + (r_i+1 - D_i / r_i) / A_i.
/// Exact for linear functions. Within 1e-9 of the polygon's size of a corner: that corner; of an edge: linear on it.
/// Positive inside a convex polygon. A polygon without extent: equal weights.
void mean_value_weights(std::span<const Vec2> polygon, const Vec2& x, std::span<double> weights);

} // namespace fascicle
