#include "bench/bench.hpp"

#include <catch2/catch.hpp>

using namespace fascicle::bench;

namespace {

FrameRow frame_row(const std::string& case_name, const std::string& method, double rate) {
    FrameRow row;
    row.case_name = case_name;
    row.method = method;
    row.run_rates = {rate};
    row.rate = spread_of(row.run_rates);
    return row;
}

ScalingRow scaling_row(int level, int threads, double ns) {
    ScalingRow row;
    row.level = level;
    row.threads = threads;
    row.ns = spread_of({ns});
    return row;
}

} // namespace

TEST_CASE("ratios go to classic of the same case, and to the published figure where there is one",
          "[bench][report]") {
    Report report;
    report.cases = {{"gluteus", 1, 9, 14, 3, true}, {"box", 1, 9, 14, 3, false}};
    report.frames = {frame_row("gluteus", "fast", 526), frame_row("gluteus", "classic", 20),
                     frame_row("box", "classic", 50), frame_row("box", "bullet", 75)};
    add_ratios(report);
    CHECK(report.frames[0].times_published.value() == Approx(10));
    CHECK(report.frames[0].times_classic.value() == Approx(26.3));
    CHECK(report.frames[1].times_classic.value() == 1);
    CHECK_FALSE(report.frames[3].times_published.has_value());
    CHECK(report.frames[3].times_classic.value() == Approx(1.5));

    Report alone;
    alone.frames = {frame_row("box", "bullet", 75)};
    add_ratios(alone);
    CHECK_FALSE(alone.frames[0].times_classic.has_value());
}

TEST_CASE("growth is against the first subdivision, speedup against one thread", "[bench][report]") {
    Report report;
    report.scaling = {scaling_row(0, 1, 10), scaling_row(1, 1, 20), scaling_row(1, 2, 12),
                      scaling_row(2, 1, 30), scaling_row(2, 2, 15)};
    add_ratios(report);
    CHECK_FALSE(report.scaling[0].growth.has_value());
    CHECK(report.scaling[1].growth.value() == 1);
    CHECK(report.scaling[3].growth.value() == 1.5);
    CHECK(report.scaling[4].growth.value() == 1.25);
    CHECK_FALSE(report.scaling[3].speedup.has_value());
    CHECK(report.scaling[4].speedup.value() == 2);
}

TEST_CASE("runs far apart are said once, and marked in the table", "[bench][report]") {
    Report report;
    report.frames = {frame_row("box", "classic", 50)};
    add_spread_warning(report);
    CHECK(report.warnings.empty());
    report.frames[0].rate = spread_of({50, 90});
    add_spread_warning(report);
    REQUIRE(report.warnings.size() == 1);
    CHECK(report.frames[0].undecided());
    const std::string text = report_table(report);
    CHECK(text.find("50.0-90.0 ?") != std::string::npos);
    CHECK(text.find("figures undecided: 1") != std::string::npos);

    FrameRow slowed = frame_row("box", "classic", 50); // runs alike, but by half a processor
    slowed.processor_share = 0.5;
    CHECK(slowed.undecided());
    slowed.threads = 2;
    CHECK_FALSE(slowed.undecided());
}
