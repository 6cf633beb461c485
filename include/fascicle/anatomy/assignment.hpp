#pragma once
// One to one assignment of rows to columns at least total cost.

#include <vector>

namespace fascicle {

/// cost: n x n, row-major, finite. column[i]: of row i, a permutation.
struct Assignment {
    std::vector<int> column;
    double cost = 0;
};

/// The least total cost, by shortest augmenting paths with potentials (Kuhn 1955, Munkres 1957; Jonker & Volgenant 1987):
/// O(n^3) at worst. Ties go to the lowest column. n >= 0.
Assignment assign_exactly(const std::vector<double>& cost, int n);

/// Nearly the least, for many rows that are in an order in which neighbours are alike, and columns too (points along a
/// curve that fills a surface): rows and columns are cut into `blocks` runs of about the same length, the runs assigned
/// exactly by their mean costs, then the rows within each run exactly; last, each row in turn exchanges its column for one
/// of its 32 cheapest with the row that has it, wherever that lowers the sum. O(n^2 + blocks^3). blocks >= 1; as many as
/// rows is exact.
Assignment assign_in_blocks(const std::vector<double>& cost, int n, int blocks);

/// assign_exactly up to `exact_limit` rows, else in so many blocks.
constexpr int exact_limit = 256;
Assignment assign(const std::vector<double>& cost, int n);

} // namespace fascicle
