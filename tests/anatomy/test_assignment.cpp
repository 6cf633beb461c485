#include "fascicle/anatomy/assignment.hpp"

#include "geometry/surface_oracles.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>

using namespace fascicle;

namespace {

double cost_of(const std::vector<double>& cost, const std::vector<int>& column) {
    double sum = 0;
    for (std::size_t i = 0; i < column.size(); ++i)
        sum += cost[i * column.size() + static_cast<std::size_t>(column[i])];
    return sum;
}

bool is_permutation_of_all(std::vector<int> column) {
    std::sort(column.begin(), column.end());
    for (std::size_t i = 0; i < column.size(); ++i)
        if (column[i] != static_cast<int>(i))
            return false;
    return true;
}

double least_cost(const std::vector<double>& cost, int n) {
    std::vector<int> column(static_cast<std::size_t>(n));
    std::iota(column.begin(), column.end(), 0);
    double least = 1e300;
    do
        least = std::min(least, cost_of(cost, column));
    while (std::next_permutation(column.begin(), column.end()));
    return least;
}

/// Squared distances of points along one curve to points along another, which is longer.
std::vector<double> curve_costs(int n, test::Random& random) {
    std::vector<double> cost;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const double x = 100.0 * i / n + random.real(-1, 1), y = 130.0 * j / n + random.real(-1, 1);
            cost.push_back((x - y) * (x - y) + 25.0);
        }
    return cost;
}

} // namespace

TEST_CASE("exact assignment costs what the best permutation costs", "[anatomy][assignment]") {
    test::Random random(8);
    for (int n = 0; n <= 7; ++n)
        for (int trial = 0; trial < 20; ++trial) {
            std::vector<double> cost;
            for (int i = 0; i < n * n; ++i) // whole numbers make ties
                cost.push_back(trial % 2 == 0 ? random.real(-5, 5) : double(random.index(4)));
            const Assignment found = assign_exactly(cost, n);
            REQUIRE(is_permutation_of_all(found.column));
            CHECK(found.cost == Approx(cost_of(cost, found.column)).margin(1e-12));
            CHECK(found.cost == Approx(least_cost(cost, n)).margin(1e-9));
        }
}

TEST_CASE("exact assignment in a case that greed gets wrong", "[anatomy][assignment]") {
    const Assignment found = assign_exactly({1, 2, 2, 100}, 2);
    CHECK(found.column == std::vector<int>{1, 0});
    CHECK(found.cost == 4.0);
}

TEST_CASE("assignment in blocks: a permutation, hardly dearer than the exact one where rows are in order",
          "[anatomy][assignment]") {
    test::Random random(12);
    for (const int n : {1, 2, 50, 97, 150}) {
        const std::vector<double> cost = curve_costs(n, random);
        const double least = assign_exactly(cost, n).cost;
        for (const int blocks : {1, 7, 20, n}) {
            if (blocks == 1 && n > 100)
                continue;
            const Assignment found = assign_in_blocks(cost, n, blocks);
            INFO(n << " rows, " << blocks << " blocks");
            REQUIRE(is_permutation_of_all(found.column));
            CHECK(found.cost >= least * (1.0 - 1e-12));
            CHECK(found.cost <= least * 1.1);
            if (blocks == 1 || blocks >= n)
                CHECK(found.cost == Approx(least));
        }
    }
    CHECK(assign_in_blocks({}, 0, 5).column.empty());
}

TEST_CASE("assignment chooses the exact way up to its limit", "[anatomy][assignment]") {
    test::Random random(13);
    for (const int n : {exact_limit, exact_limit + 5}) {
        const std::vector<double> cost = curve_costs(n, random);
        const Assignment found = assign(cost, n);
        REQUIRE(is_permutation_of_all(found.column));
        const double least = assign_exactly(cost, n).cost;
        CHECK(found.cost <= least * (n <= exact_limit ? 1.0 + 1e-12 : 1.1));
    }
}
