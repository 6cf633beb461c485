#include "app/cli/progress.hpp"

#include <catch2/catch.hpp>
#include <sstream>

using namespace fascicle::app;
using Catch::Matchers::Contains;

namespace {

/// Frames 0 to `total`, ten a second, after one second of "prepare"; returns what was written.
std::string run(ProgressDisplay::Style style, int total, int columns = 80) {
    std::ostringstream out;
    ProgressDisplay display(out, style, columns);
    for (int i = 0; i <= 100; ++i)
        display.update({"prepare", i / 100.0, 0, 0}, i / 100.0);
    for (int k = 0; k <= total; ++k)
        display.update({"solve", double(k) / total, k, total}, 1 + k / 10.0);
    display.finish();
    return out.str();
}

std::size_t count(const std::string& text, char c) {
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), c));
}

} // namespace

TEST_CASE("without a terminal there is a line for every tenth of the frames", "[app][progress]") {
    const std::string text = run(ProgressDisplay::Style::lines, 300);
    CHECK(count(text, '\n') == 11);
    CHECK(text.substr(0, text.find('\n')) == "prepare");
    CHECK_THAT(text, Contains("solve 10 %, frame 30 of 300, 10.0 frames/s, 0:27 left\n"));
    CHECK_THAT(text, Contains("solve 100 %, frame 300 of 300, 10.0 frames/s, 0:00 left\n"));
    CHECK(count(text, '\r') == 0);

    CHECK(count(run(ProgressDisplay::Style::lines, 3), '\n') == 4);
}

TEST_CASE("the bar is redrawn ten times a second at most and wiped at the end", "[app][progress]") {
    const std::string text = run(ProgressDisplay::Style::bar, 1000);
    CHECK_THAT(text, Contains("solve [############............] 50 %  500/1000  10.0 frames/s, 0:50 left"));
    CHECK(count(text, '\n') == 0);
    CHECK(text.substr(text.size() - 4) == "\r\033[K");

    std::ostringstream out;
    ProgressDisplay display(out, ProgressDisplay::Style::bar);
    for (int k = 0; k < 10000; ++k)
        display.update({"solve", k / 10000.0, k, 10000}, k / 10000.0);
    CHECK(count(out.str(), '\r') <= 11);
}

TEST_CASE("a narrow terminal cuts the bar so that it stays on its line", "[app][progress]") {
    std::ostringstream out;
    ProgressDisplay display(out, ProgressDisplay::Style::bar, 20);
    display.update({"solve", 0.5, 5, 10}, 0);
    CHECK(out.str() == "\rsolve [############\033[K");
}

TEST_CASE("quiet writes nothing", "[app][progress]") {
    CHECK(run(ProgressDisplay::Style::none, 300).empty());
}

TEST_CASE("durations read as clocks do", "[app][progress]") {
    CHECK(duration_text(0) == "0:00");
    CHECK(duration_text(4.4) == "0:04");
    CHECK(duration_text(750) == "12:30");
    CHECK(duration_text(3723) == "1:02:03");
    CHECK(duration_text(-5) == "0:00");
}
