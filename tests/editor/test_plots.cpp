// The plots as a person uses them: pointer, legends, earlier runs, exports, overlays.

#include "editor/dialogs/dialogs.hpp"
#include "editor/driver.hpp"
#include "editor/features.hpp"
#include "fascicle/document/actions/parameter_actions.hpp"
#include "fascicle/io/csv.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/png.hpp"
#include "fascicle/scene/embedded_scenes.hpp"
#include "fascicle/simulation/simulation.hpp"
#include "render/imgui_host.hpp"
#include "support/temp_dir.hpp"

#include <catch2/catch.hpp>
#include <pugixml.hpp>

using namespace fascicle;
using namespace fascicle::editor;
using fascicle::test::Driver;

namespace {

const char* const volume = "plot/volume_ratio";
const char* const area = "plot/volume_ratio/area";

/// A place inside a plot, by shares.
ImVec2 at(const Rect& r, float x, float y) {
    return {r.min.x + r.width() * x, r.min.y + r.height() * y};
}

void measure(Driver& d) {
    d.frame(3);
    d.editor().metrics().finish();
    d.frame(2);
}

/// A finished run, measured.
void run_through(Driver& d, int frames = 61) {
    d.frame(3);
    d.run()->compute(frames);
    d.run()->finish();
    measure(d);
}

void another_run(Driver& d, double stiffness, int frames = 61) {
    actions::set_parameter(d.document(), "solver.stiffness", stiffness);
    d.settle();
    run_through(d, frames);
}

void menu(Driver& d, const char* entry, const std::string& plot = area) {
    d.click(plot, 1);
    d.click(std::string("plots/menu/") + entry);
}

void write_into(Driver& d, const std::filesystem::path& path) {
    d.frame(2);
    d.click("plot_export/name");
    d.key(key_a, {.ctrl = true});
    d.type(path.string());
    d.click("plot_export/write");
    d.editor().dialogs().plot_export.finish();
    d.frame(3);
}

std::vector<std::vector<double>> numbers(const std::string& bytes, std::vector<std::string>& columns) {
    CsvReader csv(bytes, "test");
    columns = csv.columns();
    std::vector<std::vector<double>> rows;
    while (csv.next_row()) {
        auto& row = rows.emplace_back();
        for (int c = 0; c < static_cast<int>(columns.size()); ++c)
            row.push_back(csv.cell(c).empty() ? std::nan("") : csv.number(c));
    }
    return rows;
}

bool has_fonts() {
    for (const std::filesystem::path& font : render::default_imgui_fonts().text)
        if (std::filesystem::exists(font))
            return true;
    return false;
}

} // namespace

TEST_CASE("The wheel zooms x about the pointer, Shift and the wheel zoom y, a double-click shows all",
          "[editor][plots]") {
    Driver d;
    run_through(d);
    d.wheel(area, 2);
    const PlotRange x = d.state().plot_range;
    CHECK(x.high - x.low == Approx(60 * 0.64).margin(1e-6));
    CHECK((x.low + x.high) / 2 == Approx(30).margin(1));
    CHECK(d.state().plots.y.empty());
    d.editor().input().key(key_left_shift, true, {.shift = true});
    d.frame();
    d.wheel(area, 1);
    REQUIRE(d.state().plots.y.count(volume) == 1);
    const PlotRange y = d.state().plots.y[volume];
    d.editor().input().wheel(1, 0); // what some systems make of Shift+wheel
    d.frame(2);
    d.editor().input().key(key_left_shift, false, {});
    d.frame();
    CHECK(d.state().plots.y[volume].high - d.state().plots.y[volume].low ==
          Approx((y.high - y.low) * 0.8).epsilon(1e-6));
    CHECK(d.state().plots.y.count("plot/edge_extension") == 0); // each has its own
    CHECK(d.state().plot_range == x);
    d.double_click(area);
    CHECK(d.state().plots.y.empty());
    CHECK(d.state().plot_range == PlotRange{0, 60});
}

TEST_CASE("Ctrl and a drag, or the middle button, pan, up and down only when meant", "[editor][plots]") {
    Driver d;
    run_through(d);
    d.wheel(area, 4);
    const PlotRange before = d.state().plot_range;
    const int playhead = d.state().playback.playhead();
    const Rect r = d.rect(area);
    d.drag(at(r, 0.5f, 0.5f), at(r, 0.3f, 0.5f), 2);
    CHECK(d.state().plot_range.low == Approx(before.low + 0.2 * (before.high - before.low)).margin(0.2));
    CHECK(d.state().plots.y.empty());
    d.editor().input().key(key_left_ctrl, true, {.ctrl = true});
    d.frame();
    d.drag(at(r, 0.3f, 0.2f), at(r, 0.5f, 0.7f));
    d.editor().input().key(key_left_ctrl, false, {});
    d.frame();
    CHECK(d.state().plot_range.low == Approx(before.low).margin(0.2));
    CHECK(d.state().plots.y.count(volume) == 1);
    CHECK(d.state().playback.playhead() == playhead); // panning is no scrubbing
}

TEST_CASE("A right drag zooms to the box, a right click opens the menu", "[editor][plots]") {
    Driver d;
    run_through(d);
    const Rect r = d.rect(area);
    d.drag(at(r, 0.25f, 0.25f), at(r, 0.75f, 0.75f), 1);
    CHECK(d.state().plot_range.low == Approx(15).margin(0.6));
    CHECK(d.state().plot_range.high == Approx(45).margin(0.6));
    REQUIRE(d.state().plots.y.count(volume) == 1);
    CHECK(d.state().plots.y[volume].high > d.state().plots.y[volume].low);
    CHECK_FALSE(d.has("plots/menu/Copy"));
    d.click(area, 1);
    CHECK(d.has("plots/menu/Copy"));
    d.click("plots/menu/Show all");
    CHECK(d.state().plot_range == PlotRange{0, 60});
    CHECK(d.state().plots.y.empty());
    CHECK_FALSE(d.has("plots/menu/Copy"));
}

TEST_CASE("Over an axis of angles a drag stays on its branch of a there-and-back motion", "[editor][plots]") {
    Driver d;
    run_through(d);
    d.state().ruler = RulerUnit::angle;
    d.frame(2);
    const Rect r = d.rect(area);
    // The muscle grows all the time: the way back lies above the way out, and the nearer curve takes the pointer.
    d.drag(at(r, 0.1f, 0.98f), at(r, 0.5f, 0.4f));
    CHECK(d.state().playback.playhead() == Approx(15).margin(1));
    d.drag(at(r, 0.1f, 0.02f), at(r, 0.5f, 0.6f));
    CHECK(d.state().playback.playhead() == Approx(45).margin(1));
    CHECK(d.editor().features().plots.planned().turns == std::vector<std::size_t>{30});
    d.wheel(area, 1);
    REQUIRE(d.state().plots.angles);
    CHECK(d.state().plots.angles->high - d.state().plots.angles->low == Approx(0.8 * 57.29578).epsilon(1e-3));
    d.double_click(area);
    CHECK(d.state().plots.angles->high == Approx(57.29578));
}

TEST_CASE("A double-click in a legend shows one curve alone, another shows all", "[editor][plots]") {
    Scene scene = test::small_scene();
    Muscle second = scene.muscles[0];
    second.name = "second";
    scene.muscles.push_back(second);
    Driver d(scene, 1600, 900);
    run_through(d, 20);
    d.double_click("plot/volume_ratio/legend/muscle");
    CHECK(d.state().hidden_curves == std::set<std::string>{"second"});
    d.double_click("plot/volume_ratio/legend/muscle");
    CHECK(d.state().hidden_curves.empty());
}

TEST_CASE("Plots can be chosen, shown alone, and laid over the view", "[editor][plots]") {
    Driver d;
    run_through(d, 20);
    CHECK_FALSE(d.has("plot/stage_time"));
    d.click("plots/choose");
    d.click("plots/show/plot/stage_time");
    d.click("plots/show/plot/dihedral_change");
    d.key(key_escape);
    d.frame(2);
    CHECK(d.has("plot/stage_time"));
    CHECK_FALSE(d.has("plot/dihedral_change"));
    d.click("plot/volume_ratio/maximise");
    CHECK(d.has(volume));
    CHECK_FALSE(d.has("plot/stage_time"));
    CHECK(d.rect(volume).width() > 900);
    d.click("plot/volume_ratio/maximise");
    CHECK(d.has("plot/stage_time"));

    CHECK_FALSE(d.has("viewport/plot/volume_ratio"));
    menu(d, "Over the view");
    CHECK(d.has("viewport/plot/volume_ratio"));
    const Rect small = d.rect("viewport/plot/volume_ratio"), view = d.rect("viewport");
    CHECK(small.min.x >= view.min.x);
    CHECK(small.max.y <= view.max.y);
    d.editor().run(Command::toggle_plots_over_view);
    d.frame(2);
    CHECK_FALSE(d.has("viewport/plot/volume_ratio"));
    d.click("plots/over_view");
    d.click("plots/over_view/1");
    d.click("plots/over_view/1/plot/edge_extension");
    CHECK(d.has("viewport/plot/edge_extension"));
    CHECK(d.rect("viewport/plot/edge_extension").max.y < d.rect("viewport/plot/volume_ratio").min.y + 1);
}

TEST_CASE("Curves of earlier runs stay, a padlock keeps one, and its parameters come back as one step",
          "[editor][plots]") {
    Driver d;
    run_through(d, 10);
    another_run(d, 0.5, 10);
    MetricsWorker& metrics = d.editor().metrics();
    REQUIRE(metrics.earlier().size() == 1);
    CHECK(metrics.earlier()[0].name == "Run 1");
    const std::uint64_t first = metrics.earlier()[0].id;
    d.click("plots/kept");
    d.click("plots/kept/0/lock");
    CHECK(metrics.earlier()[0].pinned);
    d.key(key_escape);
    for (const double stiffness : {0.51, 0.52, 0.53, 0.54, 0.55, 0.56})
        another_run(d, stiffness, 3);
    CHECK(metrics.earlier().size() == MetricsWorker::kept_runs);
    REQUIRE(metrics.find(first) != nullptr);
    CHECK(metrics.earlier().back().id == first);
    CHECK(metrics.earlier().front().name == "Run 7");

    const std::size_t steps = d.document().history().steps().size();
    d.click("plots/kept");
    d.click("plots/kept/4/restore");
    CHECK(d.document().scene().parameters.get("solver.stiffness") == 0.9);
    CHECK_FALSE(d.document().scene().parameters.edited("solver.stiffness"));
    CHECK(d.document().history().steps().size() == steps + 1);
    CHECK(d.document().history().undo_name() == "Restore parameters of Run 1");
    d.click("plots/kept/4/lock");
    CHECK_FALSE(metrics.find(first)->pinned);
    d.click("plots/kept/0/remove");
    CHECK(metrics.earlier().size() == 4);
}

TEST_CASE("A right click on an earlier curve restores what made it", "[editor][plots]") {
    Driver d(test::small_scene(), 1280, 800);
    run_through(d, 61);
    another_run(d, 0.5, 3); // the new curve ends early: the old one is alone further on
    d.click("plot/volume_ratio/maximise");
    const MetricValues& ghost = d.editor().metrics().earlier().at(0);
    const auto row = static_cast<std::size_t>(metric_index("volume_ratio"));
    // Where the curve is on the screen: what is visible is the curve's own range and 1, with some air.
    double low = 1, high = 1;
    for (const auto& frame : ghost.rows) {
        low = std::min(low, frame[0][row]);
        high = std::max(high, frame[0][row]);
    }
    const double air = (high - low) * 0.08, value = ghost.rows[40][0][row];
    const Rect r = d.rect(area);
    const auto y = static_cast<float>((value - low + air) / (high - low + 2 * air));
    d.move_to(at(r, 40.0f / 60, 1 - y));
    d.press(1);
    d.release(1);
    d.frame(3);
    REQUIRE(d.has("plots/menu/Restore its parameters"));
    d.click("plots/menu/Restore its parameters");
    CHECK(d.document().scene().parameters.get("solver.stiffness") == 0.9);
}

TEST_CASE("The numbers of a plot are written as csv and read back the same", "[editor][plots]") {
    const test::TempDir folder;
    Driver d;
    run_through(d, 61);
    menu(d, "CSV of this plot...");
    write_into(d, folder.path() / "volume.csv");
    CHECK_FALSE(d.editor().dialogs().plot_export.is_open());
    std::vector<std::string> columns;
    const std::string bytes = read_file(folder.path() / "volume.csv");
    CHECK(bytes.find('\r') == std::string::npos);
    auto rows = numbers(bytes, columns);
    CHECK(columns == std::vector<std::string>{"frame", "time_s", "angle_deg", "volume_ratio"});
    REQUIRE(rows.size() == 61);
    const auto row = static_cast<std::size_t>(metric_index("volume_ratio"));
    for (std::size_t k = 0; k < 61; ++k) {
        CHECK(rows[k][0] == double(k));
        CHECK(rows[k][3] == d.editor().metrics().current().rows[k][0][row]);
    }
    CHECK(rows[30][2] == Approx(57.29578));
    const std::string origin = read_file(folder.path() / "volume.json");
    CHECK(origin.find("\"solver.stiffness\": \"0.9\"") != std::string::npos);

    d.state().plot_range = {10, 20};
    d.frame(2);
    menu(d, "CSV of the visible range...");
    write_into(d, folder.path() / "part.csv");
    rows = numbers(read_file(folder.path() / "part.csv"), columns);
    REQUIRE(rows.size() == 11);
    CHECK(rows[0][0] == 10);

    another_run(d, 0.5, 5);
    menu(d, "CSV of all plots...");
    write_into(d, folder.path() / "all.csv");
    rows = numbers(read_file(folder.path() / "all.csv"), columns);
    for (const char* wanted :
         {"volume_ratio", "edge_extension_mean", "edge_extension_p10", "edge_extension_p90",
          "dihedral_change_mean_rad", "penetration_max_mm", "run_1_volume_ratio"})
        CHECK(std::count(columns.begin(), columns.end(), wanted) == 1);
    const auto now = std::find(columns.begin(), columns.end(), "volume_ratio") - columns.begin();
    CHECK(std::isnan(rows[30][std::size_t(now)])); // not computed yet: an empty cell

    menu(d, "Copy");
    rows = numbers(ImGui::GetClipboardText(), columns);
    CHECK(rows.size() == 61);
    CHECK(columns.size() == 5);
}

TEST_CASE("Plots are written as SVG and PNG, one file each", "[editor][plots]") {
    const test::TempDir folder;
    Driver d;
    run_through(d, 61);
    menu(d, "Image...");
    write_into(d, folder.path() / "volume.svg");
    pugi::xml_document svg;
    REQUIRE(svg.load_file((folder.path() / "volume.svg").c_str()));
    CHECK(svg.select_nodes("//path[@class='curve']").size() == 1);
    CHECK(svg.child("svg").attribute("width").as_int() == 640);

    d.editor().run(Command::export_plots);
    d.frame(3);
    d.click("plot_export/SVG");
    write_into(d, folder.path() / "plots.svg");
    for (const char* name : {"plots_volume_ratio.svg", "plots_edge_extension.svg", "plots_penetration.svg"})
        CHECK(std::filesystem::exists(folder.path() / name));

    if (!has_fonts()) {
        WARN("no font: no PNG");
        return;
    }
    menu(d, "Image...");
    d.click("plot_export/PNG");
    write_into(d, folder.path() / "volume.png");
    const PngImage image = read_png(folder.path() / "volume.png");
    CHECK(image.width == 1280); // 2x
    CHECK(image.height == 720);
    std::size_t orange = 0; // the curve's colour in the light theme
    for (std::size_t i = 0; i + 3 < image.rgba.size(); i += 4)
        orange += image.rgba[i] == 0xc0 && image.rgba[i + 1] == 0x7f && image.rgba[i + 2] == 0x00;
    CHECK(orange > 500);
}

TEST_CASE("When a plot cannot be written the dialog says so and offers another name", "[editor][plots]") {
    Driver d;
    run_through(d, 5);
    menu(d, "CSV of this plot...");
    write_into(d, "/proc/no such place/volume.csv");
    CHECK(d.editor().dialogs().plot_export.is_open());
    CHECK(d.has("plot_export/write"));
    d.click("plot_export/cancel");
    CHECK_FALSE(d.editor().dialogs().plot_export.is_open());
}

TEST_CASE("A csv is laid over a plot, in frames, seconds or degrees, and what is none is refused",
          "[editor][plots]") {
    const test::TempDir folder;
    write_file(folder.path() / "measured.csv", "frame,mean,upper\n0,1,1.1\n30,1.05,\n60,1.02,1.2\n");
    write_file(folder.path() / "wrong.csv", "muscle,value\na,1\n");
    Driver d;
    run_through(d, 61);
    menu(d, "Overlay a CSV...");
    d.click("browser/path");
    d.key(key_a, {.ctrl = true});
    d.type((folder.path() / "measured.csv").string());
    d.key(key_enter);
    d.click("plot_overlay/take");
    d.editor().features().plots.finish();
    d.frame(3);
    const PlotData& data = d.editor().features().plots;
    REQUIRE(data.overlays().size() == 1);
    REQUIRE(data.overlays()[0].curves.size() == 2);
    CHECK(data.overlays()[0].curves[1].x == std::vector<double>{0, 60}); // the empty cell is passed over
    CHECK(d.has("plot/volume_ratio/legend/measured.csv"));
    CHECK_FALSE(d.has("plot/edge_extension/legend/measured.csv"));
    d.click("plot/volume_ratio/legend/measured.csv");
    CHECK(d.state().hidden_curves.count("measured.csv") == 1);
    menu(d, "Remove overlays");
    CHECK(data.overlays().empty());

    d.editor().features().plots.read_overlay(folder.path() / "wrong.csv", volume);
    d.editor().features().plots.finish();
    d.frame(3);
    CHECK(d.editor().log().unseen_errors() == 1);
    CHECK(d.editor().log().latest()->text.find("'muscle' is no axis") != std::string::npos);
    CHECK(d.editor().log().latest()->text.find('\n') == std::string::npos);
    CHECK(data.overlays().empty());
}

TEST_CASE("An overlaid curve lies where its time or angle is", "[editor][plots]") {
    const test::TempDir folder;
    const auto read = [&](const char* text) {
        write_file(folder.path() / "o.csv", text);
        return read_overlay(folder.path() / "o.csv", volume);
    };
    const Scene scene = test::small_scene(); // 1 rad over 30 frames, and back
    std::vector<double> planned;
    for (int k = 0; k <= 60; ++k)
        planned.push_back(scene.timeline.angle_rad(k) * 57.29577951308232);
    PlotOverlay overlay = read("time [ms];v\n500;1\n1000;2\n");
    place_overlay(overlay, 1.0 / 60, scene.timeline, planned);
    CHECK(overlay.curves[0].frames[0] == Approx(30));
    CHECK(overlay.curves[0].degrees[0] == Approx(57.29578));
    CHECK(overlay.curves[0].degrees[1] == Approx(0).margin(1e-9));
    overlay = read("hip_flexion_rad,v\n0.5,1\n2,2\n");
    place_overlay(overlay, 1.0 / 60, scene.timeline, planned);
    CHECK(overlay.curves[0].frames[0] == Approx(15)); // on the way out
    CHECK(std::isnan(overlay.curves[0].frames[1]));   // the motion does not come there
    CHECK(overlay.curves[0].degrees[1] == Approx(114.59156));
    CHECK_THROWS_WITH(read("frame\n1\n"), Catch::Contains("columns"));
    CHECK_THROWS_WITH(read("frame,v\n1,x\n"), Catch::Contains("line 2"));
    CHECK_THROWS_WITH(read("frame,v\n1,\n"), Catch::Contains("no values"));
    CHECK_THROWS(read_overlay(folder.path() / "missing.csv", volume));
}

TEST_CASE("A fibre's curve lights up the fibre, and the fibre its curve", "[editor][plots]") {
    Scene scene = make_embedded_scene("cylinder");
    scene.parameters.set_text("fibres.method", "kukacka");
    scene.parameters.set("fibres.count", 9);
    scene.timeline.last_frame = 8;
    const auto recording = std::make_shared<Recording>(std::make_shared<const Scene>(scene));
    run_simulation(*recording, {1}, {});
    REQUIRE(recording->state() == RunState::finished);
    Driver d(scene, 1600, 1000);
    d.editor().show(recording);
    measure(d);
    const std::size_t count = d.editor().metrics().current().fibres.at(0).count;
    REQUIRE(count > 3);
    CHECK(d.editor().metrics().current().fibres[0].lengths_mm.size() == 9 * count);
    CHECK(d.editor().metrics().current().fibres[0].moment_arms_mm.size() == 9 * count);
    d.click("plot/fibre_length/maximise");
    const Rect r = d.rect("plot/fibre_length/area");
    std::set<int> seen;
    for (int i = 1; i < 60; ++i) {
        d.move_to(at(r, 0.5f, float(i) / 60));
        if (d.state().hover_fibre)
            seen.insert(d.state().hover_fibre->fibre);
    }
    CHECK(seen.size() > 1);
    CHECK(*seen.rbegin() < static_cast<int>(count));
    d.click("plots/choose");
    d.click("plots/single_fibres");
    d.key(key_escape);
    d.frame(2);
    for (int i = 1; i < 20; ++i) {
        d.move_to(at(r, 0.5f, float(i) / 20));
        CHECK_FALSE(d.state().hover_fibre);
    }
}

TEST_CASE("An idle worker does not wake up", "[editor][metrics]") {
    MetricsWorker worker;
    worker.follow(test::small_recording(5));
    worker.finish();
    const std::uint64_t before = worker.wake_ups();
    std::this_thread::sleep_for(std::chrono::milliseconds(150));
    CHECK(worker.wake_ups() <= before + 1); // it may have been on its way to sleep
    CHECK_FALSE(worker.behind());
}
