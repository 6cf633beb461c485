#include "bench/spread.hpp"

#include <catch2/catch.hpp>

using namespace fascicle::bench;

TEST_CASE("median, least and greatest of odd, even and no runs", "[bench][spread]") {
    const Spread odd = spread_of({5, 1, 9});
    CHECK(odd.median == 5);
    CHECK(odd.min == 1);
    CHECK(odd.max == 9);
    CHECK(odd.runs == 3);
    CHECK(spread_of({4, 1, 2, 8}).median == 3);
    const Spread one = spread_of({7});
    CHECK((one.median == 7 && one.min == 7 && one.max == 7));
    CHECK(spread_of({}).runs == 0);
    CHECK_FALSE(spread_of({}).undecided());
}

TEST_CASE("rates turn least and greatest round", "[bench][spread]") {
    const Spread rate = spread_of_rates(100, {2, 4, 5});
    CHECK(rate.median == 25);
    CHECK(rate.min == 20);
    CHECK(rate.max == 50);
}

TEST_CASE("runs a fifth apart are undecided", "[bench][spread]") {
    CHECK_FALSE(spread_of({100, 110, 119}).undecided());
    CHECK(spread_of({100, 110, 123}).undecided());
    CHECK_FALSE(spread_of({1e-9, 1e-9}).undecided());
}
