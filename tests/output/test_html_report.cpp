#include "editor/hand_run.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/metrics/metric_table.hpp"
#include "output/export_job.hpp"
#include "output/html_report.hpp"
#include "output/report_charts.hpp"
#include "output/run_pictures.hpp"
#include "render/osmesa_context.hpp"
#include "support/temp_dir.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <set>

using namespace fascicle;
using namespace fascicle::output;

namespace {

ReportInput input_of(const RecordingPtr& recording) {
    ReportInput input;
    input.recording = recording;
    input.date = "2026-01-02 03:04";
    MetricsEngine engine(*recording);
    for (int k = 0; k < recording->frame_count(); ++k)
        input.rows.push_back(engine.measure(*recording->frame(k)));
    input.furthest = most_flexed_frame(*recording);
    return input;
}

int count(const std::string& text, const std::string& part) {
    int n = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++n;
    return n;
}

/// Every tag that is opened is closed, in order; the names of what was seen.
std::set<std::string> check_nesting(const std::string& html) {
    const std::set<std::string> empty{"meta", "img", "br", "!DOCTYPE"};
    std::vector<std::string> open;
    std::set<std::string> seen;
    for (std::size_t at = html.find('<'); at != std::string::npos; at = html.find('<', at + 1)) {
        const bool closing = html[at + 1] == '/';
        const std::size_t begin = at + 1 + (closing ? 1 : 0);
        const std::string name = html.substr(begin, html.find_first_of(" >\n/", begin) - begin);
        const std::size_t end = html.find('>', at);
        seen.insert(name);
        if (closing) {
            INFO("closing " << name << " at " << at);
            REQUIRE_FALSE(open.empty());
            REQUIRE(open.back() == name);
            open.pop_back();
        } else if (empty.count(name) == 0 && html[end - 1] != '/') {
            open.push_back(name);
        }
        at = end;
    }
    CHECK(open.empty());
    return seen;
}

} // namespace

TEST_CASE("A report holds facts, plots with sentences from the data, and numbers, and needs nothing else",
          "[output][unit]") {
    Scene scene = test::small_scene();
    scene.parameters.set("solver.stiffness", 0.7);
    const RecordingPtr recording = test::small_recording(31, scene);
    recording->add_note("The muscle was mended.");
    ReportInput input = input_of(recording);
    input.pictures.push_back({"At rest", 0, {2, 1, {1, 2, 3, 255, 4, 5, 6, 255}}});
    const std::string html = html_report(input);
    const std::set<std::string> tags = check_nesting(html);
    CHECK(tags.count("script") == 0);
    CHECK(tags.count("link") == 0);
    const int plots = static_cast<int>(report_charts(input).size());
    CHECK(plots == 5);
    CHECK(count(html, "<div class=\"light\"><svg") == plots);
    CHECK(count(html, "<div class=\"dark\"><svg") == plots);
    for (const char* part :
         {"2026-01-02 03:04", "66</td>", "128</td>", "3 origin, 3 insertion", "solver.stiffness", ">0.7<",
          ">0.9<", "The muscle was mended.", "src=\"data:image/png;base64,iVBOR", "prefers-color-scheme",
          "@media print", "Mean edge extension", "<html lang=\"en\">",
          // z is stretched by 0.002 a frame, so the volume is, too
          "departs from its volume at rest by at most 6 % (more in frame 30)",
          "50 frames a second in the median"}) {
        INFO(part);
        CHECK(html.find(part) != std::string::npos);
    }
    // Nothing is fetched: the only address is the name space of SVG.
    for (std::size_t at = html.find("://"); at != std::string::npos; at = html.find("://", at + 1))
        CHECK(html.substr(at, 17) == "://www.w3.org/200");
    CHECK(html.find("url(") == std::string::npos);
}

TEST_CASE("Names in a report are text, whatever they hold", "[output][unit]") {
    Scene scene = test::small_scene();
    scene.name = "a \"b\" & <c>";
    scene.muscles[0].name = "<script>alert(1)</script>";
    scene.bones[0].name = "<img src=x onerror=alert(2)>";
    Muscle second = scene.muscles[0]; // two, so that names are in legends too
    second.name = "'><svg onload=alert(3)>";
    scene.muscles.push_back(second);
    const RecordingPtr recording = test::small_recording(3, scene);
    recording->add_note("</ul><script>");
    const std::string html = html_report(input_of(recording));
    check_nesting(html);
    for (const char* bad : {"<script", "<img src=x", "<svg onload", "a \"b\" & <c>"})
        CHECK(html.find(bad) == std::string::npos);
    CHECK(html.find("&lt;script&gt;alert(1)&lt;/script&gt;") != std::string::npos);
    CHECK(html.find("Of 2 muscles the one furthest off") != std::string::npos);
}

TEST_CASE("A report of a run that failed early, and of rest alone", "[output][unit]") {
    const auto recording = std::make_shared<Recording>(std::make_shared<const Scene>(test::small_scene()));
    recording->set_attachments({{}});
    recording->append(test::small_recording(1)->frame(0));
    recording->finish(RunState::failed, "the muscle is open");
    const std::string html = html_report(input_of(recording));
    check_nesting(html);
    CHECK(html.find("The run failed: the muscle is open") != std::string::npos);
    CHECK(html.find("<svg") == std::string::npos);
    CHECK(html.find("Nothing had to be mended") != std::string::npos);
}

TEST_CASE("Numbers in a report are short", "[output][unit]") {
    CHECK(short_number(1.0) == "1");
    CHECK(short_number(0.123456) == "0.123");
    CHECK(short_number(12.3456) == "12.3");
    CHECK(short_number(12345.6) == "12346");
    CHECK(short_number(-0.00001234) == "-1.23e-05");
    CHECK(short_number(0) == "0");
    CHECK(short_number(-0.0000) == "0");
    CHECK(short_number(std::nan("")) == "\xE2\x80\x93");
    const Extremes e = extremes({std::nan(""), 3, 1, 2});
    CHECK(e.least == 2);
    CHECK(e.greatest == 1);
    CHECK(extremes({}).least == -1);
}

TEST_CASE("The export of a report draws four pictures and measures the run", "[output][picture]") {
    const render::OsmesaContext gl;
    const test::TempDir folder;
    const RecordingPtr recording = test::small_recording(61);
    ExportRequest request;
    request.kind = "report";
    request.target = folder.path() / "report.html";
    PictureLook look;
    look.camera = view::picture_camera(view::subject_of(*recording, 0), 1.5);
    ExportJob job(request, recording, look);
    CHECK(job.total() == 4);
    job.finish();
    const std::string html = read_file(request.target);
    check_nesting(html);
    CHECK(count(html, "data:image/png;base64,") == 4);
    CHECK(html.find("<b>Furthest from rest</b>, frame 30, 57.3\xC2\xB0") != std::string::npos);
    CHECK(html.find("linear-gradient") != std::string::npos);
}
