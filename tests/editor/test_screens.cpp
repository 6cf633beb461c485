#include "editor/hand_run.hpp"
#include "editor/screen_stage.hpp"
#include "fascicle/base/error.hpp"
#include "render/drawing.hpp"

#include <catch2/catch.hpp>
#include <set>

using namespace fascicle;
using namespace fascicle::editor;

namespace {

bool has_fonts() {
    const render::ImguiHost host;
    return host.has_text_font() && host.has_icons();
}

/// The small scene, and another run of it with softer edges.
std::vector<RecordingPtr> small_runs() {
    Scene other = test::small_scene();
    other.parameters.set("solver.stiffness", 0.4);
    return {test::small_recording(61), test::small_recording(61, other)};
}

void check_screen(const char* golden, void (*prepare)(ScreenStage&), bool dark = true) {
    ScreenOptions options;
    options.width = 1100;
    options.height = 700;
    options.dark = dark;
    ScreenStage stage(small_runs(), options);
    stage.state().playback.position = 20;
    stage.frames(4);
    prepare(stage);
    stage.frames(6);
    test::check_golden(stage.picture(), golden);
}

} // namespace

TEST_CASE("Golden: main screens of the editor", "[editor][golden][screens]") {
    if (!has_fonts()) {
        WARN("fascicle-skip: fonts are missing");
        return;
    }
    check_screen("screen_paint", [](ScreenStage& s) {
        s.click("tree/fixed");
        s.run(Command::paint_mode);
        s.frames(20);
    });
    check_screen(
        "screen_motion", [](ScreenStage& s) { s.run(Command::show_motion); }, false);
    check_screen("screen_display", [](ScreenStage& s) {
        s.run(Command::show_display);
        s.state().colouring = view::Colouring::strain;
        s.run(Command::toggle_section);
    });
    check_screen(
        "screen_fibres", [](ScreenStage& s) { s.tab("fibres"); }, false);
    check_screen("screen_shortcuts", [](ScreenStage& s) { s.run(Command::show_shortcuts); });
}

TEST_CASE("Every screen has a name of its own, and an unknown one is refused", "[editor][screens]") {
    std::set<std::string> ids;
    for (const ScreenRow& row : screens()) {
        CHECK(ids.insert(row.id).second);
        CHECK(std::string(row.title).size() > 4);
    }
    CHECK(ids.size() >= 12);
    ScreenOptions options;
    options.only = {"no-such-screen"};
    CHECK_THROWS_AS(draw_screens(options), Error);
}

TEST_CASE("Two runs side by side are two pictures", "[editor][screens]") {
    ScreenOptions options;
    options.width = 900;
    options.height = 560;
    ScreenStage stage(small_runs(), options);
    stage.second_run();
    stage.tab("compare");
    stage.run(Command::compare_side_by_side);
    stage.frames(10);
    const Rect a = stage.rect("viewport/a"), b = stage.rect("viewport/b");
    CHECK(a.width() > 20);
    CHECK(b.min.x > a.max.x);
}
