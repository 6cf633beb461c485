#include "editor/driver.hpp"
#include "editor/param_effect.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;
using namespace fascicle::editor;
using fascicle::test::Driver;

namespace {

struct Size {
    float width, height, scale;
};

void draw_all(const Scene& scene, int frames_of_run, RunState state) {
    for (const Size size :
         {Size{1280, 800, 1}, Size{320, 240, 1}, Size{2560, 1600, 2}, Size{900, 500, 1.5f}}) {
        INFO(size.width << " x " << size.height);
        Driver d(scene, size.width, size.height, size.scale);
        for (const PanelRow& row : panel_registry()) {
            if (row.place == Place::bottom)
                d.state().bottom_panel = row.id;
            if (row.place == Place::parameters)
                d.state().side_panel = row.id;
            d.frame(3);
            if (d.run() != nullptr && frames_of_run > 0)
                d.run()->compute(frames_of_run);
        }
        if (d.run() != nullptr && state != RunState::running) {
            d.run()->recording()->finish(state, state == RunState::failed ? "muscle: not closed" : "");
            d.run()->finished = true;
        }
        d.state().selection = {Selection::Kind::muscle, "muscle"};
        for (const view::ColouringRow& row : view::colourings()) {
            d.state().colouring = row.colouring;
            d.frame(3);
        }
        d.state().selection = {Selection::Kind::bone, "turning"};
        d.state().dark = false;
        d.frame(3);
        d.state().selection = {Selection::Kind::bone, "no longer there"};
        d.state().show_shortcuts = true;
        d.frame(3);
    }
}

} // namespace

TEST_CASE("Every panel draws an empty scene", "[editor][panels]") {
    draw_all(Scene{}, 0, RunState::running);
}

TEST_CASE("Every panel draws a scene whose run begins, is under way, ends and fails", "[editor][panels]") {
    draw_all(test::small_scene(), 0, RunState::running);
    draw_all(test::small_scene(), 20, RunState::running);
    draw_all(test::small_scene(), 61, RunState::finished);
    draw_all(test::small_scene(), 0, RunState::failed);
    draw_all(test::small_scene(), 7, RunState::cancelled);
}

TEST_CASE("Every panel of a usual window is there and inside it", "[editor][panels]") {
    Driver d;
    d.frame(3);
    d.run()->compute(61);
    d.frame(3);
    for (const char* name :
         {"menu/File", "toolbar/open", "toolbar/undo", "toolbar/colouring", "toolbar/stop", "tree/muscle",
          "tree/fixed/eye", "viewport", "parameter/solver.stiffness", "parameter/solver.method",
          "timeline/play", "timeline/ruler", "plot/volume_ratio/area", "plot/edge_extension/area",
          "plot/dihedral_change/area", "tab/messages", "status/message"}) {
        INFO(name);
        if (std::string(name) == "status/message" && d.editor().log().messages().empty())
            continue;
        const Rect r = d.rect(name);
        CHECK(r.width() > 8);
        CHECK(r.height() > 4);
        CHECK(r.min.x >= 0);
        CHECK(r.max.x <= 1280);
        CHECK(r.max.y <= 800);
    }
    for (const ParamRow& row : parameter_table().rows()) {
        INFO(row.key);
        if (of_another_method(d.document().scene(), row))
            CHECK_FALSE(d.has("parameter/" + row.key)); // out of sight until its method is chosen
        else
            CHECK(d.rect("parameter/" + row.key).width() > 60); // has its control and is not scrolled away
    }
}

TEST_CASE("Panel ids and places are complete", "[editor][panels]") {
    std::set<std::string> ids;
    std::set<Place> places;
    for (const PanelRow& row : panel_registry()) {
        CHECK(ids.insert(row.id).second);
        places.insert(row.place);
        CHECK(row.make() != nullptr);
    }
    CHECK(places.size() == 10);
}
