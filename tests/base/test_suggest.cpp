#include "fascicle/base/suggest.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;

TEST_CASE("edit distance counts insertions, deletions, replacements and swaps", "[base][suggest]") {
    CHECK(edit_distance("", "") == 0);
    CHECK(edit_distance("", "abc") == 3);
    CHECK(edit_distance("abc", "") == 3);
    CHECK(edit_distance("kitten", "sitting") == 3);
    CHECK(edit_distance("simulate", "simulaet") == 1);
    CHECK(edit_distance("threads", "thread") == 1);
    CHECK(edit_distance("scenes", "scenes") == 0);
}

TEST_CASE("the nearest name is found, and nothing when nothing is near", "[base][suggest]") {
    const std::vector<std::string> known{"simulate", "scenes", "info", "render"};
    CHECK(nearest_name("simulat", known) == "simulate");
    CHECK(nearest_name("sim", known) == "simulate");
    CHECK(nearest_name("redner", known) == "render");
    CHECK(nearest_name("banana", known).empty());
    CHECK(nearest_name("", known).empty());
    CHECK(nearest_name(std::string(100000, 's'), known).empty());
    CHECK(did_you_mean("scens", known) == "; did you mean 'scenes'?");
    CHECK(did_you_mean("zzzzzz", known).empty());
}
