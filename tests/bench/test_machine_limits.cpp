#include "bench/machine_limits.hpp"

#include <atomic>
#include <catch2/catch.hpp>

using namespace fascicle::bench;

TEST_CASE("threads that run together all run, once each", "[bench][limits]") {
    for (const int threads : {1, 3}) {
        std::vector<std::atomic<int>> calls(static_cast<std::size_t>(threads));
        CHECK(run_together(threads, [&](int t) { ++calls[static_cast<std::size_t>(t)]; }) > 0);
        for (const auto& count : calls)
            CHECK(count == 1);
    }
}

TEST_CASE("every limit is measured for every number of threads", "[bench][limits]") {
    Machine machine;
    machine.l2_bytes = 1 << 16;
    machine.l3_bytes = 1 << 18;
    const auto rows = measure_limits(machine, {1, 2}, 2, 1e-4, {});
    CHECK(can_run_lanes(1));
    REQUIRE(rows.size() >= 2 * (3 + 3));
    for (std::size_t i = 0; i < rows.size(); i += 2) {
        CHECK(rows[i].name == rows[i + 1].name);
        CHECK((rows[i].threads == 1 && rows[i + 1].threads == 2));
        CHECK((rows[i].value.min > 0 && rows[i + 1].value.min > 0));
    }
    const std::atomic<bool> stop{true};
    fascicle::JobControl control;
    control.cancel = &stop;
    CHECK_THROWS_AS(measure_limits(machine, {1}, 1, 1e-4, control), fascicle::Cancelled);
}
