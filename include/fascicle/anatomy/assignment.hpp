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

/// Nearly the least: pairs are taken in the order of their cost, then rows exchange their columns two by two as long as
/// that lowers the sum, in a fixed order, at most `rounds` times over all pairs. O(n^2 log n) and n^2 a round; never more
/// than the greedy cost. A few percent above the least on fibre ends.
Assignment assign_greedily(const std::vector<double>& cost, int n, int rounds = 30);

/// assign_exactly up to `exact_limit` rows, else assign_greedily.
constexpr int exact_limit = 400;
Assignment assign(const std::vector<double>& cost, int n);

} // namespace fascicle
