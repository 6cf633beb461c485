#pragma once
// The splines of a path's moving points.

#include "io/osim_export/bake_fibre.hpp"

namespace fascicle::io {

/// Sets knots and values at them for the moving points of a path, whose bodies and fixed points are known: with the fewest knots that
/// keep length, moment arm and points within the tolerance, or those that come nearest to it.
///
/// Points first, by least squares in their bodies. Where there is a joint their values y are then changed until the length follows
/// the target (LengthTarget) at places q_s, four to a knot: with d_s the length that is missing there, by Gauss-Newton the least change
///   dy = J^T (J J^T + e I)^-1 d,   J_(s, ij) = B_i(q_s) R_j(q_s)^T (t_(j-1) - t_j),
/// B: the splines of unit values, R_j: turn of point j's body, t_j: unit vector from point j to the next.
void fit_path(const FibreBaking& baking, const FibreCourse& course, FibrePath& path);

} // namespace fascicle::io
