#include "view/chart_svg.hpp"
#include "view/decimate.hpp"
#include "view/ticks.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <pugixml.hpp>
#include <sstream>

using namespace fascicle::view;

namespace {

Chart volume_chart() {
    Chart chart;
    chart.title = "Volume ratio <of> \"a & b\"";
    chart.unit = "mm";
    chart.x_label = "frame";
    ChartCurve curve;
    curve.name = "muscle";
    curve.colour = {1, 0, 0, 1};
    for (int k = 0; k <= 10; ++k) {
        curve.x.push_back(k);
        curve.y.push_back(1 + 0.1 * k);
        curve.low.push_back(0.9 + 0.1 * k);
        curve.high.push_back(1.1 + 0.1 * k);
    }
    chart.curves.push_back(curve);
    return chart;
}

pugi::xml_document parsed(const std::string& svg) {
    pugi::xml_document document;
    const pugi::xml_parse_result result =
        document.load_buffer(svg.data(), svg.size(), pugi::parse_default, pugi::encoding_utf8);
    INFO(result.description());
    REQUIRE(result);
    return document;
}

std::vector<std::pair<double, double>> points_of(const pugi::xml_node& path) {
    std::string d = path.attribute("d").value();
    for (char& c : d)
        if (std::isalpha(static_cast<unsigned char>(c)))
            c = ' ';
    std::istringstream in(d);
    std::vector<std::pair<double, double>> points;
    for (double x = 0, y = 0; in >> x >> y;)
        points.emplace_back(x, y);
    return points;
}

pugi::xpath_node_set all(const pugi::xml_document& document, const char* query) {
    return document.select_nodes(query);
}

} // namespace

TEST_CASE("A chart as SVG is well-formed XML with every sample, its band and round ticks", "[view][chart]") {
    const Chart chart = volume_chart();
    const pugi::xml_document document = parsed(chart_svg(chart, 400, 240));
    CHECK(document.child("svg").attribute("width").as_int() == 400);
    CHECK(std::string(document.child("svg").child("title").text().get()) ==
          "Volume ratio <of> \"a & b\" [mm]");
    const auto curves = all(document, "//path[@class='curve']");
    REQUIRE(curves.size() == 1);
    const auto points = points_of(curves[0].node());
    REQUIRE(points.size() == 11);
    const double step = points[1].first - points[0].first;
    for (std::size_t k = 1; k < points.size(); ++k) { // straight in the data, straight in the picture
        CHECK(points[k].first - points[k - 1].first == Approx(step).margin(0.02));
        CHECK(points[k].second - points[k - 1].second ==
              Approx(points[1].second - points[0].second).margin(0.02));
    }
    CHECK(points[1].second < points[0].second); // up is more
    CHECK(std::string(curves[0].node().attribute("stroke").value()) == "#ff0000");
    REQUIRE(all(document, "//path[@class='band']").size() == 1);
    CHECK(points_of(all(document, "//path[@class='band']")[0].node()).size() == 22);
    std::vector<std::string> texts;
    for (const auto& node : all(document, "//text"))
        texts.emplace_back(node.node().text().get());
    for (const char* wanted : {"frame", "muscle", "0", "2", "10", "1.0", "1.5", "2.0"})
        CHECK(std::count(texts.begin(), texts.end(), wanted) >= 1);
}

TEST_CASE("Gaps, ghosts, the reference and the playhead of a chart are in its SVG", "[view][chart]") {
    Chart chart = volume_chart();
    chart.curves[0].y[5] = std::nan("");
    ChartCurve ghost = volume_chart().curves[0];
    ghost.ghost = true;
    ghost.low.clear();
    ghost.high.clear();
    chart.curves.push_back(ghost);
    ChartCurve dot;
    dot.name = "one";
    dot.x = {3};
    dot.y = {1.2};
    dot.dashed = true;
    chart.curves.push_back(dot);
    const std::size_t lines = all(parsed(chart_svg(chart, 400, 240)), "//line").size();
    chart.reference = 1;
    chart.playhead = 4;
    const pugi::xml_document document = parsed(chart_svg(chart, 400, 240, true));
    CHECK(all(document, "//path[@class='curve']").size() == 2); // before the gap and after it
    CHECK(points_of(all(document, "//path[@class='curve']")[0].node()).size() == 5);
    CHECK(all(document, "//path[@class='ghost']").size() == 1);
    CHECK(all(document, "//circle").size() == 1);
    CHECK(all(document, "//line").size() == lines + 2);
    chart.playhead = 11; // outside of what is shown
    CHECK(all(parsed(chart_svg(chart, 400, 240)), "//line").size() == lines + 1);
}

TEST_CASE("Charts without data, with one value or with huge ones are pictures all the same",
          "[view][chart]") {
    Chart chart;
    chart.title = "Nothing";
    CHECK(all(parsed(chart_svg(chart, 300, 200)), "//path").empty());
    chart = volume_chart();
    for (double& y : chart.curves[0].y)
        y = 7e300;
    chart.curves[0].low.clear();
    CHECK(chart_y(chart).low < 7e300);
    CHECK(chart_y(chart).high > 7e300);
    parsed(chart_svg(chart, 1, 1));
    chart.curves[0].y.assign(11, std::numeric_limits<double>::infinity());
    const ChartSpan span = chart_y(chart);
    CHECK(std::isfinite(span.low));
    CHECK(std::isfinite(span.high));
    CHECK(all(parsed(chart_svg(chart, 300, 200)), "//path[@class='curve']").empty());
}

TEST_CASE("A chart's axis of y follows the samples inside a range of x, and an own range wins",
          "[view][chart]") {
    Chart chart = volume_chart();
    chart.curves[0].low.clear();
    chart.curves[0].high.clear();
    chart.x_range = {{2, 4}};
    CHECK(chart_y(chart).low == Approx(1.2 - 0.2 * 0.08));
    CHECK(chart_y(chart).high == Approx(1.4 + 0.2 * 0.08));
    chart.y_range = {{-1, 3}};
    CHECK(chart_y(chart).low == -1);
    chart.y_range = {{3, 3}}; // no range at all
    CHECK(chart_y(chart).high < 2);
}

TEST_CASE("Points that pixels cannot tell apart are left out, ends and extremes stay", "[view][chart]") {
    std::vector<ScreenPoint> points;
    for (int i = 0; i <= 100000; ++i)
        points.push_back({i * 0.001, i == 50123 ? 40.0 : i == 70321 ? -3.0 : std::sin(i * 0.37)});
    const std::vector<ScreenPoint> kept = decimated(points);
    CHECK(kept.size() <= 4 * 101);
    CHECK(kept.front().x == points.front().x);
    CHECK(kept.back().x == points.back().x);
    const auto by_y = [](const ScreenPoint& a, const ScreenPoint& b) { return a.y < b.y; };
    CHECK(std::max_element(kept.begin(), kept.end(), by_y)->y == 40);
    CHECK(std::min_element(kept.begin(), kept.end(), by_y)->y == -3);
    for (std::size_t i = 1; i < kept.size(); ++i)
        CHECK(kept[i].x > kept[i - 1].x);
    CHECK(decimated({}).empty());
    CHECK(decimated({{1, 2}}).size() == 1);
}

TEST_CASE("Ticks are written with as many decimals as tell them apart, and never as -0", "[view][chart]") {
    const Ticks ticks = nice_ticks(-0.2, 0.4, 6);
    CHECK(ticks.step == Approx(0.1));
    CHECK(ticks.count == 7);
    CHECK(tick_text(ticks.at(2), ticks.step) == "0.0");
    CHECK(tick_text(ticks.at(0), ticks.step) == "-0.2");
    CHECK(tick_text(20000000, 5000000) == "2.0e+07");
    CHECK(nice_ticks(1, 1, 4).count == 0);
    CHECK(nice_ticks(0, std::numeric_limits<double>::infinity(), 4).count == 0);
}

TEST_CASE("An axis has two ticks at least where there is room, since one tells no scale", "[view][chart]") {
    CHECK(nice_ticks(90, 310, 2).count == 1);
    CHECK(scale_ticks(90, 310, 2, 0.3).count == 3); // 100, 200, 300
    CHECK(scale_ticks(90, 310, 2, 0.5).count == 1); // would be too close
    for (const double low : {-3.7, 0.0, 0.9971, 1e-5, -2e6})
        for (const double span : {1e-4, 0.37, 0.8, 1.0, 55.0, 3e6})
            for (int count = 1; count <= 9; ++count) {
                INFO(low << " + " << span << ", " << count);
                const Ticks wide = nice_ticks(low, low + span, count),
                            ticks = scale_ticks(low, low + span, count, 0.2 - 1e-9);
                CHECK(ticks.count >= 2);
                if (wide.count >= 2) {
                    CHECK(ticks.step == wide.step);
                    CHECK(ticks.count == wide.count);
                } else {
                    CHECK(ticks.step >= (0.2 - 1e-6) * span);
                }
            }
    CHECK(scale_ticks(1, 1, 4, 0.1).count == 0);
}

TEST_CASE("Text in SVG and HTML is escaped", "[view][chart]") {
    CHECK(xml_escaped("a<b>&\"'\x01") == "a&lt;b&gt;&amp;&quot;&#39;");
    CHECK(xml_escaped("angle [\xC2\xB0]") == "angle [\xC2\xB0]");
}
