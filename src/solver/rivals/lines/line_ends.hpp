#pragma once
// Where the lines of a sheaf begin and end: vertices spread evenly over an attachment, and who is joined to whom.

#include "fascicle/base/types.hpp"

#include <span>
#include <vector>

namespace fascicle::solver {

/// At most `count` of `vertices`, each near to the middle of one of as many parts of about equal width (farthest points, then Lloyd's
/// rounds, means weighted by `areas`, one per point). Fewer where places are the same. Deterministic.
std::vector<int> even_vertices(const Points& points, const std::vector<double>& areas,
                               std::span<const int> vertices, int count);

/// Puts `to` (as many as `from`) into an order in which no two lines from[k] -> to[k] gain by changing places: the sum of squared
/// lengths is least among all swaps of a pair, so that in a plane no two lines cross.
void pair_ends(const Points& points, std::span<const int> from, std::vector<int>& to);

} // namespace fascicle::solver
