#pragma once
// How fast the interpolant of a distance grid can change: the bound that lets contact skip vertices that are far away.

#include "fascicle/geometry/distance_grid.hpp"

namespace fascicle::solver {

/// A Lipschitz constant of DistanceGrid::sample().value inside the grid, at least 1: the largest over all cells of
/// sqrt(dx^2 + dy^2 + dz^2), where dx is the largest difference along the cell's edges in x, per spacing, and so on. The step from the
/// grid's saturated border to the saturation outside counts as well: it is zero.
double largest_slope(const DistanceGrid& grid, int threads);

} // namespace fascicle::solver
