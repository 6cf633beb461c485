#include "fascicle/metrics/percentile.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

using namespace fascicle;

namespace {

std::vector<double> of(std::vector<double> values, const std::vector<double>& percents) {
    std::vector<double> result;
    percentiles(values, percents, result);
    return result;
}

} // namespace

TEST_CASE("percentiles by hand", "[metrics][percentile]") {
    CHECK(of({4, 1, 3, 2}, {0, 50, 100}) == std::vector<double>{1, 2.5, 4});
    CHECK(of({10, 40, 20, 30, 50}, {0, 10, 25, 90, 97.5}) == std::vector<double>{10, 14, 20, 46, 49});
    CHECK(of({7}, {0, 1, 50, 99, 100}) == std::vector<double>{7, 7, 7, 7, 7});
    CHECK(of({2, 2, 2}, {1, 99}) == std::vector<double>{2, 2});
}

TEST_CASE("percentiles of a shuffled row", "[metrics][percentile]") {
    std::vector<double> values;
    for (int i = 0; i < 1001; ++i)
        values.push_back((i * 389) % 1001); // a permutation of 0 .. 1000
    std::vector<double> percents;
    for (int p = 0; p <= 100; ++p)
        percents.push_back(p);
    const std::vector<double> result = of(values, percents);
    for (int p = 0; p <= 100; ++p)
        CHECK(result[static_cast<std::size_t>(p)] == Approx(10.0 * p).margin(1e-9));
}

TEST_CASE("percentiles of nothing and of what is not finite", "[metrics][percentile]") {
    const double nan = std::numeric_limits<double>::quiet_NaN(),
                 inf = std::numeric_limits<double>::infinity();
    CHECK(std::isnan(of({}, {50})[0]));
    CHECK(of({nan, 1, nan, 2, 3}, {0, 50, 100}) == std::vector<double>{1, 3, inf});
}
