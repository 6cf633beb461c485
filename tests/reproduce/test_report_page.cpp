#include "reproduce/charts.hpp"
#include "reproduce/findings.hpp"
#include "reproduce/page.hpp"
#include "reproduce/published.hpp"
#include "reproduce/results_json.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>

using namespace fascicle;
using namespace fascicle::reproduce;

namespace {

/// Curves of a method whose volume is off by `off` at most, with two fibres that shorten and come back.
MethodRun made_run(const std::string& method, double off, int frames) {
    MethodRun row;
    row.method = method;
    RunData& run = row.run;
    run.method = method;
    run.last_frame = frames;
    run.triangles = 1000;
    run.vertices = 502;
    run.state_hash = "0123456789abcdef";
    for (int k = 0; k <= frames; ++k) {
        const double x = 300.0 * k / frames;
        const double bent = x <= 100 ? x / 100 : x <= 200 ? 2 - x / 100 : 0;
        run.frame.push_back(x);
        run.angle_deg.push_back(-57.29577951308232 * bent);
        const std::pair<const char*, double> values[] = {{"volume_ratio", 1 - off * bent},
                                                         {"edge_extension_mean", 1 + off * bent},
                                                         {"edge_extension_p10", 1},
                                                         {"edge_extension_p90", 1 + 2 * off * bent},
                                                         {"edge_extension_p99", 1 + 3 * off * bent},
                                                         {"dihedral_change_mean_rad", 0.1 * bent},
                                                         {"dihedral_change_p10_rad", 0.0},
                                                         {"dihedral_change_p90_rad", 0.2 * bent},
                                                         {"dihedral_change_unsigned_mean_deg", 2 * bent},
                                                         {"penetrating_vertices", 0},
                                                         {"displacement_mean_mm", 5 * bent},
                                                         {"fibre_length_mean_mm", 100 - 15 * bent}};
        for (const auto& [key, value] : values)
            run.metrics[key].push_back(value);
        for (const double shift : {-1.0, 1.0}) {
            run.fibres.length_mm.push_back(100 - 15 * bent + shift);
            run.fibres.moment_arm_mm.push_back(30 + shift);
        }
    }
    run.fibres.names = {"0", "1"};
    return row;
}

Results made_results() {
    Results results;
    results.data = "made for a test, <&> \"quoted\"";
    results.methods = {"xpbd", "classic"};
    ExperimentResult iliacus;
    iliacus.experiment = find_experiment("iliacus");
    iliacus.real = true;
    iliacus.runs.push_back(made_run("xpbd", 0.001, 30));
    iliacus.runs.push_back(made_run("classic", 0.02, 30));
    MethodRun failed;
    failed.method = "another";
    failed.failure = "it <failed> & stopped";
    iliacus.runs.push_back(failed);
    render::Image image;
    image.width = 2;
    image.height = 1;
    image.rgba = {255, 0, 0, 255, 0, 0, 255, 255};
    iliacus.runs[0].pictures.push_back({"frame 100", image});
    find_out(iliacus);
    results.experiments.push_back(iliacus);
    ExperimentResult missing;
    missing.experiment = find_experiment("gluteus_medius");
    missing.missing = "not in the data: gluteus_medius.vtk";
    results.experiments.push_back(missing);
    results.sensitivity.missing = "was not asked for";
    results.speed.rows = {{"box", "xpbd", true, 5292, 1, 10, 200.0},
                          {"iliacus", "xpbd", true, 13858, 1, 10, 80.0}};
    results.speed.correlations = {{"xpbd", 1, 2, -1}};
    return results;
}

const Finding* finding(const ExperimentResult& result, const std::string& about) {
    for (const Finding& f : result.findings)
        if (f.about == about)
            return &f;
    return nullptr;
}

} // namespace

TEST_CASE("reproduce: the page is well-formed XML without scripts or references", "[reproduce][unit]") {
    const std::string page = report_page(made_results(), "2026-01-02 03:04");
    pugi::xml_document document;
    const pugi::xml_parse_result parsed = document.load_buffer(page.data(), page.size(), pugi::parse_full);
    INFO(parsed.description()
         << " at " << parsed.offset << ": "
         << page.substr(static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, parsed.offset - 60)), 120));
    REQUIRE(parsed);
    CHECK(document.child("html"));
    CHECK(document.select_nodes("//*[local-name()='script']").empty());
    CHECK(document.select_nodes("//*[local-name()='svg' and local-name(..)='figure']").size() >= 6);
    for (const pugi::xpath_node& node : document.select_nodes("//@src"))
        CHECK(std::string(node.attribute().value()).starts_with("data:image/png;base64,"));
    CHECK(document.select_nodes("//@href").empty());
    CHECK(page.find("url(") == std::string::npos);
    CHECK(page.find("it &lt;failed&gt; &amp; stopped") != std::string::npos);
    CHECK(page.find("gluteus_medius.vtk") != std::string::npos);
    CHECK(page.find("nan") == std::string::npos);
}

TEST_CASE("reproduce: sentences are made from the data", "[reproduce][unit]") {
    ExperimentResult result = made_results().experiments[0];
    const Finding* volume = finding(result, "volume_ratio");
    REQUIRE(volume != nullptr);
    CHECK(volume->figure == "12");
    CHECK(volume->verdict == Verdict::better);
    CHECK(volume->text == "With xpbd iliacus departs from its volume at rest by at most 0.1 %, classic 2 %.");
    const Finding* fibres = finding(result, "fibre_length_mean_mm");
    REQUIRE(fibres != nullptr);
    CHECK(fibres->figure == "20");
    CHECK(fibres->verdict == Verdict::kept);
    // A flexor that lengthens is worse, and so is a worse volume.
    result.runs[0] = made_run("xpbd", 0.05, 30);
    for (double& length : result.runs[0].run.metrics["fibre_length_mean_mm"])
        length = 200 - length;
    find_out(result);
    CHECK(finding(result, "volume_ratio")->verdict == Verdict::worse);
    CHECK(finding(result, "fibre_length_mean_mm")->verdict == Verdict::worse);
}

TEST_CASE("reproduce: published numbers are marks beside real muscles alone", "[reproduce][unit]") {
    ExperimentResult result = made_results().experiments[0];
    const auto marks = [&] {
        std::size_t count = 0;
        for (const Plot& plot : experiment_plots(result))
            for (const view::ChartCurve& curve : plot.chart.curves)
                count += curve.name == "published program" ? 1 : 0;
        return count;
    };
    CHECK(marks() == 4); // volume, mean edge, 99th percentile, dihedral
    result.real = false;
    CHECK(marks() == 0);
}

TEST_CASE("reproduce: results hold no times", "[reproduce][unit]") {
    Results results = made_results();
    const std::string before = results_json(results);
    results.seconds = 1234;
    results.speed.rows[0].frames_per_second = 1;
    results.experiments[0].runs[0].run.times = {1, 2, 3, 4};
    results.experiments[0].runs[0].reused = true;
    CHECK(results_json(results) == before);
    const auto json = nlohmann::json::parse(before);
    CHECK(json["experiments"][0]["runs"][0]["metrics"]["volume_ratio"]["least"] == 0.999);
    CHECK(json["experiments"][0]["runs"][2]["failed"] == "it <failed> & stopped");
    CHECK(json["experiments"][1]["left_out"] == "not in the data: gluteus_medius.vtk");
    CHECK(nlohmann::json::parse(timings_json(results))["seconds"] == 1234);
}

TEST_CASE("reproduce: published bands are in order", "[reproduce][unit]") {
    for (const char* muscle : {"iliacus", "gluteus_maximus", "gluteus_medius"}) {
        const std::vector<BandPoint>& band = arm_band(muscle);
        REQUIRE(band.size() == 4);
        for (std::size_t i = 0; i < band.size(); ++i) {
            CHECK(band[i].low < band[i].high);
            CHECK((i == 0 || band[i - 1].x < band[i].x));
        }
    }
    CHECK(arm_band("box").empty());
    for (const PublishedArm& arm : published_arms())
        CHECK((arm.least < arm.mean && arm.mean < arm.greatest));
}
