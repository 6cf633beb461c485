#include "fascicle/base/parallel.hpp"
#include "fascicle/base/state_hash.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;

TEST_CASE("FNV-1a of known strings", "[base][state_hash]") {
    StateHash hash;
    CHECK(hash.hex() == "cbf29ce484222325");
    hash.add_bytes("a", 1);
    CHECK(hash.hex() == "af63dc4c8601ec8c");
}

TEST_CASE("positive and negative zero hash alike, any other bit does not", "[base][state_hash]") {
    StateHash a, b, c;
    a.add_points({Vec3(0.0, 1.0, 2.0)});
    b.add_points({Vec3(-0.0, 1.0, 2.0)});
    c.add_points({Vec3(0.0, 1.0, std::nextafter(2.0, 3.0))});
    CHECK(a.value() == b.value());
    CHECK(a.value() != c.value());
}

TEST_CASE("parallel_for covers every index once, with the same chunks for any thread count",
          "[base][parallel]") {
    const int threads = GENERATE(1, 2, 3, 8);
    std::vector<int> seen(1003, 0);
    std::vector<std::size_t> ends(11, 0);
    parallel_for(threads, seen.size(), 100, [&](std::size_t begin, std::size_t end) {
        ends[begin / 100] = end;
        for (std::size_t i = begin; i < end; ++i)
            ++seen[i];
    });
    CHECK(std::count(seen.begin(), seen.end(), 1) == 1003);
    CHECK(ends[3] == 400);
    CHECK(ends[10] == 1003);
}

TEST_CASE("an exception in a parallel body reaches the caller", "[base][parallel]") {
    const int threads = GENERATE(1, 2);
    CHECK_THROWS_AS(parallel_for(threads, 100, 10,
                                 [](std::size_t begin, std::size_t) {
                                     if (begin == 50)
                                         throw std::runtime_error("here");
                                 }),
                    std::runtime_error);
}
