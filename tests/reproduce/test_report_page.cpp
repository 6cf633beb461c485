#include "reproduce/arm_shares.hpp"
#include "reproduce/charts.hpp"
#include "reproduce/findings.hpp"
#include "reproduce/page.hpp"
#include "reproduce/page_writer.hpp"
#include "reproduce/published.hpp"
#include "reproduce/results_json.hpp"
#include "reproduce/sweep.hpp"
#include "reproduce/words.hpp"

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

TEST_CASE("reproduce: variants and speeds that failed are told, also where others are held against them",
          "[reproduce][unit]") {
    Results results = made_results();
    SensitivityResult& s = results.sensitivity;
    s.missing.clear();
    s.experiment = "iliacus";
    s.method = "xpbd";
    s.quantities = {"volume ratio"};
    SensitivityVariant given, base, half;
    given.key = "as given";
    given.values = {1.0};
    base.key = "remeshed evenly";
    base.failure = "no space on the disk";
    half.key = "half the triangles";
    half.base = 1;
    half.values = {0.75};
    s.variants = {given, base, half};
    results.speed.failures = {"box, classic: no <memory>"};
    const std::string page = report_page(results, "2026-01-02 03:04");
    CHECK(page.find("no space on the disk") != std::string::npos);
    CHECK(page.find(">0.75</td>") != std::string::npos); // nothing to hold it against
    CHECK(page.find("Not measured: box, classic: no &lt;memory&gt;") != std::string::npos);
}

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
    CHECK(volume->text ==
          "With xpbd iliacus departs from its volume at rest by at most 0.1 %; with classic at most 2 %.");
    const std::string about_fibres = fibre_lengths_about("xpbd");
    const Finding* fibres = finding(result, about_fibres);
    REQUIRE(fibres != nullptr);
    CHECK(fibres->figure == "20");
    CHECK(fibres->verdict == Verdict::kept);
    // A flexor that lengthens is worse, and so is a worse volume.
    result.runs[0] = made_run("xpbd", 0.05, 30);
    for (double& length : result.runs[0].run.metrics["fibre_length_mean_mm"])
        length = 200 - length;
    find_out(result);
    CHECK(finding(result, "volume_ratio")->verdict == Verdict::worse);
    CHECK(finding(result, about_fibres)->verdict == Verdict::worse);
    // What is rounding is called so, and the worst of several rivals is named.
    result.runs[0] = made_run("xpbd", 1e-8, 30);
    result.runs[2] = made_run("fem", 0.03, 30);
    result.runs.push_back(made_run("arap", 0.04, 30));
    find_out(result);
    CHECK(
        finding(result, "volume_ratio")->text ==
        "With xpbd iliacus departs from its volume at rest by less than 0.0001 %; with classic at most 2 %; "
        "with arap, the worst of the rivals, at most 4 %.");
    CHECK(finding(result, "penetrating_vertices")->text ==
          "With xpbd iliacus has 0 vertices inside bones; with classic 0; with every rival 0.");
}

TEST_CASE("reproduce: every plot has a sentence", "[reproduce][unit]") {
    ExperimentResult result = made_results().experiments[0];
    const auto untold = [&] {
        std::string names;
        for (const Plot& plot : experiment_plots(result))
            if (finding(result, plot.about) == nullptr && plot.about != "moment_arm_mm")
                names += plot.chart.title + "; ";
        return names;
    };
    CHECK(untold().empty());
    result.runs.erase(result.runs.begin()); // without the program's own method
    find_out(result);
    CHECK(untold().empty());
    CHECK(finding(result, "volume_ratio")->verdict == Verdict::shown);
    result.experiment = find_experiment("iliacus-published");
    find_out(result);
    for (const Plot& plot : experiment_plots(result))
        CHECK((finding(result, plot.about) != nullptr || plot.chart.title.starts_with("Fibre") ||
               plot.about == "moment_arm_mm"));
}

TEST_CASE("reproduce: plots of fibres share a scale, counts begin at 0, dots at the end are whole",
          "[reproduce][unit]") {
    ExperimentResult result = made_results().experiments[0];
    for (double& length : result.runs[1].run.fibres.length_mm)
        length += 100;
    std::vector<view::ChartSpan> fibres;
    for (const Plot& plot : experiment_plots(result)) {
        const view::ChartSpan x = view::chart_x(plot.chart), y = view::chart_y(plot.chart);
        if (plot.chart.title.starts_with("Fibre lengths"))
            fibres.push_back(y);
        if (plot.chart.title.starts_with("Vertices"))
            CHECK((y.low > -0.1 && y.high >= 1));
        CHECK(x.high > (plot.chart.x_label == "frame" ? 300 : 60));
    }
    REQUIRE(fibres.size() == 2);
    CHECK((fibres[0].low == fibres[1].low && fibres[0].high == fibres[1].high));
    CHECK((fibres[0].low < 85 && fibres[0].high > 200));
}

TEST_CASE("reproduce: arms of adduction are held against the published ranges", "[reproduce][unit]") {
    ExperimentResult result;
    result.experiment = find_experiment("iliacus-adduction");
    result.real = true;
    MethodRun row;
    row.method = "xpbd";
    RunData& run = row.run;
    run.method = "xpbd";
    run.last_frame = 12;
    run.fibres.names = {"0", "1"};
    run.lines.names = {"iliacus_r", "psoas_r"};
    for (int k = 0; k <= 12; ++k) {
        const double angle = k <= 4 ? 10.0 * k : 40.0 - 10.0 * (k - 4); // of the joint; the scan's is its 0
        run.frame.push_back(25.0 * k);
        run.angle_deg.push_back(angle - sweep_turn(MotionKind::adduction).rest_deg);
        // On the way to where the sweep begins nothing counts.
        const double arm = k <= 4 ? 1000 : angle / 2;
        run.fibres.moment_arm_mm.insert(run.fibres.moment_arm_mm.end(), {arm - 1, arm + 1});
        run.fibres.length_mm.insert(run.fibres.length_mm.end(), {100.0, 110.0});
        run.lines.moment_arm_mm.insert(run.lines.moment_arm_mm.end(), {k <= 4 ? 1000 : 2.0, 9.0});
        run.lines.length_mm.insert(run.lines.length_mm.end(), {100.0, 110.0});
    }
    result.runs.push_back(row);
    const WayOut poses = arm_poses(*result.experiment, run);
    REQUIRE(poses.places.size() == 8);
    CHECK(poses.flexion_deg.front() == Approx(-40));
    CHECK(poses.flexion_deg.back() == Approx(30));
    CHECK((poses.places.front() == 12 && poses.places.back() == 5));

    measure_arms(result);
    REQUIRE(result.arms.size() == 2);
    const ArmShare& own = result.arms[0];
    CHECK(own.who == "xpbd");
    CHECK((own.all_mm.least == -21 && own.all_mm.greatest == 16 && own.arm_mm.least == -20));
    REQUIRE(own.table.size() == 3);
    CHECK(own.table[0].model == "100 fibres"); // -10 to 16: means -10, -5, 0, 5, 10, 15 of 8
    CHECK(own.table[0].poses_percent == Approx(75));
    CHECK(own.table[0].arms_percent == Approx(100 * 11 / 16.0));
    CHECK(result.arms[1].who == "iliacus_r (line)");
    CHECK(result.arms[1].table[1].poses_percent == 100);

    find_out(result);
    REQUIRE(result.findings.size() == 1);
    CHECK(result.findings[0].verdict == Verdict::shown);
    CHECK(result.findings[0].text.starts_with(
        "In hip adduction the fibres of iliacus have moment arms of -21 to 16 mm, mean -2.5; "
        "the lines of the model: 2 to 2 mm, mean 2; published: 100 fibres -10 to 16 mm, mean 2 "
        "(75 % of poses with the mean inside)"));
    const std::vector<Plot> plots = experiment_plots(result);
    REQUIRE(plots.size() == 1);
    CHECK(plots[0].chart.curves[0].name == "100 fibres, Modenese & Kohout 2020");
    CHECK((plots[0].chart.curves[0].low[0] == -10 && plots[0].chart.curves[0].high[0] == 16));

    result.real = false; // a stand-in is held against nothing
    result.arms.clear();
    measure_arms(result);
    CHECK(result.arms[0].table.empty());
}

TEST_CASE("reproduce: speeds are told beside the paper's own rank correlation", "[reproduce][unit]") {
    const Finding kept = judge_speed(made_results().speed);
    CHECK(kept.verdict == Verdict::kept);
    CHECK(kept.text == "Rank correlation (Spearman) of frames a second with triangles: paper -1 (5 objects); "
                       "xpbd on 1 thread -1 "
                       "(2 objects).");
    SpeedResult other;
    other.correlations = {{"xpbd", 2, 3, 0.5}, {"classic", 1, 1, std::nan("")}};
    const Finding shown = judge_speed(other);
    CHECK(shown.verdict == Verdict::shown);
    CHECK(shown.text.ends_with(
        "; xpbd on 2 threads 0.5 (3 objects); classic on 1 thread not known (1 object)."));
    const std::string page = report_page(made_results(), "2026-01-02 03:04");
    for (const PublishedSpeed& row : published_speeds()) // all of the paper's objects, measured here or not
        CHECK(page.find(std::string(row.object)) != std::string::npos);
}

TEST_CASE("reproduce: numbers are told without exponents", "[reproduce][unit]") {
    CHECK(told_number(0) == "0");
    CHECK(told_number(3.94e-14) == "<0.0001");
    CHECK(told_number(-2e-7, 5) == ">-0.0001");
    CHECK(told_number(0.00012) == "0.00012");
    CHECK(told_number(-41.66) == "-41.7");
    CHECK(told_number(13858, 5) == "13858");
    CHECK(told_figures("") == "");
    CHECK(told_figures("7") == "Figure 7");
    CHECK(told_figures("3, 4") == "Figures 3, 4");
    CHECK(told_name("gluteus_maximus") == "gluteus maximus");
    CHECK(PageWriter::cell(1e-9) == "&lt;0.0001");
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
        CHECK((arm.least < arm.greatest && arm.least <= arm.mean && arm.mean <= arm.greatest));
}
