#include "editor/driver.hpp"
#include "editor/param_effect.hpp"
#include "fascicle/document/actions/parameter_actions.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;
using namespace fascicle::editor;
using fascicle::test::Driver;

namespace {

const char* const stiffness = "parameter/solver.stiffness";

double value(Driver& d, const char* key = "solver.stiffness") {
    return d.document().scene().parameters.get(key);
}

std::size_t steps(Driver& d) {
    return d.document().history().steps().size();
}

bool same_camera(const view::Camera& a, const view::Camera& b) {
    return a.eye() == b.eye() && a.pivot() == b.pivot() && a.orthographic() == b.orthographic();
}

/// Place on a widget, by share of its width.
ImVec2 at(const Rect& r, float share) {
    return {r.min.x + r.width() * share, (r.min.y + r.max.y) / 2};
}

} // namespace

TEST_CASE("Dragging a slider changes the parameter with one undo step and one new run", "[editor][ui]") {
    Driver d;
    d.frame(3);
    CHECK(d.runs_started() == 1);
    d.run()->compute(10);
    const Rect slider = d.rect(stiffness);
    d.drag(at(slider, 0.9f), at(slider, 0.3f));
    CHECK(value(d) == Approx(0.3).margin(0.05));
    CHECK(steps(d) == 2);
    CHECK(d.document().history().undo_name() == "Set Edge stiffness");
    CHECK(d.runs_started() == 1); // not yet: the scene must settle
    d.settle();
    CHECK(d.runs_started() == 2);
    CHECK(d.run()->recording()->scene().parameters.get("solver.stiffness") == value(d));

    d.click("parameter/solver.stiffness/reset");
    CHECK(value(d) == 0.9);
    CHECK(steps(d) == 3);
    d.key(key_z, {.ctrl = true});
    CHECK(value(d) == Approx(0.3).margin(0.05));
    d.key(key_z, {.ctrl = true});
    CHECK(value(d) == 0.9);
    d.key(key_z, {.ctrl = true, .shift = true});
    CHECK(value(d) == Approx(0.3).margin(0.05));
    d.key(key_z, {.ctrl = true});
    d.key(key_y, {.ctrl = true});
    CHECK(value(d) == Approx(0.3).margin(0.05));
}

TEST_CASE("Every slider works from end to end of its range", "[editor][ui][slow]") {
    Driver d(test::small_scene(), 1280, 1500); // all rows in sight
    d.frame(3);
    d.click("parameter/fibres.method"); // so that rows about fibres are live
    d.click("parameter/fibres.method/kukacka");
    for (const std::string& method : parameter_table().find("solver.method")->choices) {
        if (d.document().scene().parameters.get_choice("solver.method") != method) {
            d.click("parameter/solver.method");
            d.click("parameter/solver.method/" + method);
        }
        CHECK(d.document().scene().parameters.get_choice("solver.method") == method);
        for (const ParamRow& row : parameter_table().rows()) {
            if (row.kind == ParamKind::choice)
                continue;
            INFO(row.key << " of " << method);
            if (of_another_method(d.document().scene(), row)) {
                // Those that were changed stay in sight.
                CHECK(d.has("parameter/" + row.key) == d.document().scene().parameters.edited(row.key));
                continue;
            }
            const Rect slider = d.rect("parameter/" + row.key);
            const double before = value(d, row.key.c_str());
            d.drag(at(slider, 0.5f), {slider.min.x - 30, at(slider, 0).y});
            const bool live = no_effect_reason(d.document().scene(), row).empty();
            CHECK(value(d, row.key.c_str()) == (live ? Approx(row.minimum) : Approx(before)));
            d.drag(at(slider, 0.5f), {slider.max.x + 30, at(slider, 0).y});
            CHECK(value(d, row.key.c_str()) == (live ? Approx(row.maximum) : Approx(before)));
        }
    }
}

TEST_CASE("Esc during a slider drag restores the value", "[editor][ui]") {
    Driver d;
    d.frame(3);
    const Rect slider = d.rect(stiffness);
    d.move_to(at(slider, 0.9f));
    d.press();
    d.editor().input().mouse_move(at(slider, 0.2f).x, at(slider, 0).y);
    d.frame(2);
    CHECK(value(d) < 0.5);
    d.key(key_escape);
    CHECK(value(d) == 0.9);
    d.editor().input().mouse_move(at(slider, 0.4f).x, at(slider, 0).y);
    d.frame(2);
    CHECK(value(d) == 0.9);
    d.release();
    CHECK(steps(d) == 1);
}

TEST_CASE("The play button plays what is computed and waits for the rest", "[editor][ui]") {
    Driver d;
    d.frame(3);
    d.run()->compute(11);
    d.frame(2);
    d.click("timeline/play");
    CHECK(d.state().playback.playing);
    d.frame(60);
    CHECK(d.state().playback.playhead() == 10);
    d.run()->compute(61);
    d.run()->finish();
    d.frame(10);
    CHECK(d.state().playback.playhead() > 10);
    d.key(key_space);
    CHECK_FALSE(d.state().playback.playing);
    const int there = d.state().playback.playhead();
    d.key(key_right);
    CHECK(d.state().playback.playhead() == there + 1);
    d.key(key_left, {.shift = true});
    CHECK(d.state().playback.playhead() == there - 9);
    d.click("timeline/last");
    CHECK(d.state().playback.playhead() == 60);
    d.key(key_home);
    CHECK(d.state().playback.playhead() == 0);
}

TEST_CASE("The ruler and the plots move the playhead", "[editor][ui]") {
    Driver d;
    d.frame(3);
    d.run()->compute(61);
    d.frame(3);
    const Rect ruler = d.rect("timeline/ruler");
    d.drag(at(ruler, 0.1f), at(ruler, 0.5f));
    CHECK(d.state().playback.playhead() == 30);
    CHECK(d.editor().runs().at(30).state == FrameState::valid);
    const Rect plot = d.rect("plot/edge_extension/area");
    d.move_to(at(plot, 0.25f));
    d.frame();
    REQUIRE(d.state().hover_frame);
    CHECK(*d.state().hover_frame == Approx(15).margin(1));
    d.drag(at(plot, 0.25f), at(plot, 0.75f));
    CHECK(d.state().playback.playhead() == Approx(45).margin(1));
    d.wheel("plot/edge_extension/area", 3);
    CHECK(d.state().plot_range.high - d.state().plot_range.low < 40);
    d.double_click("plot/edge_extension/area");
    CHECK(d.state().plot_range.low == 0);
    CHECK(d.state().plot_range.high == 60);
}

TEST_CASE("A click in a legend hides the curve, another shows it", "[editor][ui]") {
    Driver d;
    d.frame(3);
    d.run()->compute(20);
    d.editor().metrics().finish();
    d.frame(3);
    d.click("plot/volume_ratio/legend/muscle");
    CHECK(d.state().hidden_curves.count("muscle") == 1);
    d.click("plot/volume_ratio/legend/muscle");
    CHECK(d.state().hidden_curves.empty());
}

TEST_CASE("The eye hides and shows, H and Shift+H and Alt+H do so for the selection", "[editor][ui]") {
    Driver d;
    d.frame(3);
    d.click("tree/turning/eye");
    CHECK_FALSE(d.state().visible("turning"));
    d.click("tree/turning/eye");
    CHECK(d.state().visible("turning"));
    d.click("tree/fixed");
    CHECK(d.state().selection == Selection{Selection::Kind::bone, "fixed"});
    d.key(key_h, {.shift = true});
    CHECK(d.state().visible("fixed"));
    CHECK_FALSE(d.state().visible("muscle"));
    d.key(key_h, {.alt = true});
    CHECK(d.state().hidden.empty());
    d.key(key_h);
    CHECK_FALSE(d.state().visible("fixed"));
    CHECK(steps(d) == 1); // looking is no change of the scene
}

TEST_CASE("A click in the view selects, a drag turns the camera, a double-click sets the pivot",
          "[editor][ui]") {
    Driver d;
    d.frame(3);
    d.key(key_pad_0 + 1);
    const view::Camera front = d.state().camera;
    d.click("viewport");
    CHECK(d.state().selection == Selection{Selection::Kind::muscle, "muscle"});
    CHECK(same_camera(d.state().camera, front));
    const ImVec2 middle = d.middle("viewport");
    d.drag(middle, {middle.x + 120, middle.y + 10});
    CHECK_FALSE(same_camera(d.state().camera, front));
    CHECK(d.state().selection.name == "muscle");
    d.key(key_pad_0 + 1);
    d.double_click("viewport");
    CHECK((d.state().camera.pivot() - Vec3(40, 10, 20)).norm() ==
          Approx(15).margin(0.6));            // on the sphere's surface
    CHECK(d.state().camera.pivot().y() < 10); // on its front
    d.key(key_escape);                        // stops the run
    d.key(key_escape);
    CHECK(d.state().selection.kind == Selection::Kind::none);
}

TEST_CASE("A right click opens the menu, a right drag pans and does not", "[editor][ui]") {
    Driver d;
    d.frame(3);
    const ImVec2 middle = d.middle("viewport");
    const Vec3 pivot = d.state().camera.pivot();
    d.drag(middle, {middle.x + 50, middle.y}, 1);
    CHECK((d.state().camera.pivot() - pivot).norm() > 0.1);
    CHECK_FALSE(d.has("menu/Frame everything"));
    d.click("viewport", 1);
    CHECK(d.has("menu/Frame everything"));
    d.click("menu/Wireframe");
    CHECK(d.state().wireframe);
}

TEST_CASE("Undo never moves the camera", "[editor][ui]") {
    Driver d;
    d.frame(3);
    actions::set_parameter(d.document(), "solver.pressure", 1.3);
    const ImVec2 middle = d.middle("viewport");
    d.drag(middle, {middle.x + 80, middle.y + 40});
    const view::Camera camera = d.state().camera;
    d.key(key_z, {.ctrl = true});
    CHECK(value(d, "solver.pressure") == 1);
    CHECK(same_camera(d.state().camera, camera));
    d.key(key_z, {.ctrl = true}); // nothing left to undo
    CHECK(same_camera(d.state().camera, camera));
}

TEST_CASE("Letters with Ctrl held do not what the letter does", "[editor][ui]") {
    Driver d;
    d.frame(3);
    d.click("tree/muscle");
    const view::Camera camera = d.state().camera;
    for (const KeyBinding& row : key_bindings())
        for (const KeyChord& chord : row.chords)
            if (chord.key >= 'A' && chord.key <= 'Z' && chord.modifiers == Modifiers{}) {
                INFO(to_text(chord));
                const bool wireframe = d.state().wireframe, attachments = d.state().attachments,
                           ghost = d.state().rest_ghost;
                if (find_binding({chord.key, {.ctrl = true}}) != nullptr)
                    continue; // a command of its own
                d.key(chord.key, {.ctrl = true});
                CHECK(d.state().wireframe == wireframe);
                CHECK(d.state().attachments == attachments);
                CHECK(d.state().rest_ghost == ghost);
                CHECK(d.state().hidden.empty());
                CHECK(same_camera(d.state().camera, camera));
                CHECK(d.state().colouring == view::Colouring::anatomy);
            }
    d.key(key_w);
    CHECK(d.state().wireframe);
}

TEST_CASE("F frames the selection, Shift+F everything", "[editor][ui]") {
    Driver d;
    d.frame(3);
    const Rect view = d.rect("viewport");
    const view::ViewSize size{double(view.width()), double(view.height())};
    // Share of the picture's width and height that the corners of a box cover; above 1 it is cut off.
    const auto covered = [&](const Vec3& low, const Vec3& high) {
        double x = 0, y = 0;
        for (int i = 0; i < 8; ++i) {
            const Vec3 corner((i & 1) != 0 ? high.x() : low.x(), (i & 2) != 0 ? high.y() : low.y(),
                              (i & 4) != 0 ? high.z() : low.z());
            const auto p = d.state().camera.project(corner, size);
            REQUIRE(p);
            x = std::max(x, std::abs(p->x() / size.width * 2 - 1));
            y = std::max(y, std::abs(p->y() / size.height * 2 - 1));
        }
        return std::max(x, y);
    };
    const Vec3 low(0, 0, 0), high(80, 20, 40);
    CHECK(covered(low, high) == Approx(0.92).margin(0.08)); // from the start
    d.click("tree/turning");
    d.key(key_f);
    CHECK(covered({60, 0, 0}, high) == Approx(0.92).margin(0.08));
    CHECK(covered(low, high) > 1.02);
    d.key(key_f, {.shift = true});
    CHECK(covered(low, high) == Approx(0.92).margin(0.08));
}

TEST_CASE("X flies to the deepest vertex, or to the free one nearest to a bone", "[editor][ui]") {
    Scene scene = test::small_scene();
    TriMesh ceiling = test::box(40, 40, 20);
    for (Vec3& p : ceiling.positions)
        p += Vec3(20, -10, 36); // the muscle's top is at z = 35 and goes up by 0.2 % a frame
    scene.bones.push_back({"ceiling", std::make_shared<const TriMesh>(ceiling), {}});
    scene.muscles[0].attachments.clear();
    Driver d(scene);
    d.frame(3);
    d.run()->compute(61);
    d.frame(3);
    const Rect view = d.rect("viewport");
    const view::ViewSize size{double(view.width()), double(view.height())};
    const auto fly_to = [&](const Vec3& vertex) {
        const view::Camera before = d.state().camera;
        d.key(key_x);
        CHECK_FALSE(same_camera(d.state().camera, before));
        CHECK((d.state().camera.pivot() - vertex).norm() < 1e-6);
        const auto p = d.state().camera.project(vertex, size);
        REQUIRE(p);
        CHECK(p->x() == Approx(size.width / 2).margin(1));
        CHECK(d.state().camera.units_per_pixel(size) < 0.2); // about 30 mm are in view
        return d.editor().log().latest()->text;
    };
    d.state().playback.position = 0;
    d.frame(2);
    const std::string near = fly_to({40, 10, 35});
    CHECK(near.rfind("Nothing penetrates", 0) == 0);
    CHECK(near.find("1.00 mm from ceiling in frame 0") != std::string::npos);
    d.state().playback.position = 20;
    d.frame(2);
    const std::string deep = fly_to({40, 10, 36.4});
    CHECK(deep.rfind("Deepest: vertex 4 of muscle, 0.40 mm inside ceiling in frame 20", 0) == 0);
    CHECK(d.editor().log().latest()->severity == Severity::note);
}

TEST_CASE("Without a bone there is no worst vertex to fly to", "[editor][ui]") {
    Scene scene = test::small_scene();
    scene.bones.clear();
    scene.timeline = {};
    scene.muscles[0].attachments.clear();
    Driver d(scene);
    d.frame(3);
    const view::Camera before = d.state().camera;
    d.key(key_x);
    CHECK(same_camera(d.state().camera, before));
}

TEST_CASE("Every colouring can be chosen in the toolbar and has its legend", "[editor][ui]") {
    Driver d;
    d.frame(3);
    for (const view::ColouringRow& row : view::colourings()) {
        INFO(row.label);
        d.click("toolbar/colouring");
        d.frame(2);
        d.click(std::string("toolbar/colouring/") + row.label);
        d.frame(2);
        CHECK(d.state().colouring == row.colouring);
        CHECK(d.rect("viewport/legend").height() > 20);
    }
    d.key(key_c);
    CHECK(d.state().colouring == view::Colouring::anatomy); // after the last the first
}

TEST_CASE("Esc stops the run, and no other starts", "[editor][ui]") {
    Driver d;
    d.frame(3);
    d.run()->compute(5);
    d.key(key_escape);
    CHECK(d.run()->cancelled);
    d.settle();
    CHECK(d.runs_started() == 1);
    CHECK(d.editor().runs().valid_count() == 5);
    d.key(key_f5);
    CHECK(d.runs_started() == 2);
}

TEST_CASE("Keys belong to a text field while it has the focus", "[editor][ui]") {
    Driver d;
    d.frame(3);
    d.click("tree/muscle");
    d.frame(2);
    d.click("selection/name");
    d.key(key_h); // no hiding
    CHECK(d.state().visible("muscle"));
    d.key(key_a, {.ctrl = true});
    d.type("gracilis");
    d.key(key_enter);
    CHECK(d.document().scene().muscles[0].name == "gracilis");
    CHECK(d.state().selection.name == "gracilis");
    d.settle();
    CHECK(d.runs_started() == 1); // a name changes no result
}

TEST_CASE("A name that was being typed is kept when something else is clicked", "[editor][ui]") {
    Driver d;
    d.frame(3);
    const std::string bone = d.document().scene().bones[0].name;
    d.click("tree/muscle");
    d.frame(2);
    d.click("selection/name");
    d.key(key_a, {.ctrl = true});
    d.type("gracilis");
    d.click("tree/" + bone);
    d.frame(2);
    CHECK(d.document().scene().muscles[0].name == "gracilis");
    CHECK(d.state().selection.name == bone);
    d.click("selection/name");
    d.key(key_a, {.ctrl = true});
    d.type("gracilis"); // taken
    d.click("tree/gracilis");
    d.frame(2);
    CHECK(d.document().scene().bones[0].name == bone);
    CHECK(d.state().selection.name == "gracilis");
}

TEST_CASE("A failed run says why, and a message opens its panel", "[editor][ui]") {
    Driver d;
    d.frame(3);
    d.run()->recording()->add_note("muscle: attached 3 vertices to fixed");
    d.run()->recording()->finish(RunState::failed, "muscle: surface is open");
    d.run()->finished = true;
    d.frame(3);
    CHECK(d.has("viewport/badge"));
    REQUIRE(d.editor().log().messages().size() == 2);
    CHECK(d.editor().log().latest()->text == "muscle: surface is open");
    d.click("status/message");
    CHECK(d.state().bottom_panel == "messages");
    CHECK(d.editor().log().unseen_errors() == 0);
}

TEST_CASE("Stale frames carry a badge", "[editor][ui]") {
    Driver d;
    d.frame(3);
    d.run()->compute(61);
    d.run()->finish();
    d.frame(3);
    CHECK_FALSE(d.has("viewport/badge"));
    actions::set_parameter(d.document(), "solver.pressure", 1.3);
    d.frame(2);
    CHECK(d.has("viewport/badge"));
    d.settle();
    CHECK(d.has("viewport/badge"));
    d.run()->compute(1);
    d.frame(2);
    CHECK_FALSE(d.has("viewport/badge")); // the playhead is at frame 0, which is new
}

TEST_CASE("Frames are drawn as often as there is something to see", "[editor][ui]") {
    Driver d;
    d.frame(3);
    REQUIRE(d.editor().next_redraw());
    CHECK(*d.editor().next_redraw() > 1.0 / 60); // a run comes along: now and then is enough
    d.editor().input().mouse_move(5, 5);
    CHECK(*d.editor().next_redraw() == 0);
    d.run()->compute(61);
    d.run()->finish();
    d.editor().metrics().finish();
    d.frame(3);
    d.editor().metrics().finish();
    CHECK_FALSE(d.editor().next_redraw());
    d.key(key_space);
    CHECK(*d.editor().next_redraw() == Approx(1.0 / 60));
}

TEST_CASE("Borders can be dragged, and the interface scaled", "[editor][ui]") {
    Driver d;
    d.frame(3);
    const float before = d.editor().layout().parameters.width();
    const ImVec2 border = d.middle("border/right");
    d.drag(border, {border.x - 60, border.y});
    CHECK(d.editor().layout().parameters.width() == Approx(before + 60).margin(2));
    d.key(key_equal, {.ctrl = true});
    CHECK(d.state().scale == 1.25f);
    d.key(key_0, {.ctrl = true});
    CHECK(d.state().scale == 1.0f);
}

TEST_CASE("History jumps to any step", "[editor][ui]") {
    Driver d;
    d.frame(3);
    for (const double v : {0.5, 0.6, 0.7})
        actions::set_parameter(d.document(), "solver.stiffness", v);
    d.click("tab/history");
    d.click("history/1");
    CHECK(value(d) == 0.5);
    d.click("history/3");
    CHECK(value(d) == 0.7);
    CHECK(steps(d) == 4);
}

TEST_CASE("Quit, full screen and pictures are wishes to the window", "[editor][ui]") {
    Driver d;
    d.frame(3);
    d.key(key_f11);
    CHECK(d.state().wants_full_screen);
    d.key(key_q, {.ctrl = true});
    CHECK(d.state().wants_quit);
    d.key(key_f12); // no GL here: an error, not a crash
    CHECK(d.editor().log().unseen_errors() == 1);
    d.key(key_f1);
    CHECK(d.has("shortcuts"));
    d.key(key_escape);
    d.frame();
    CHECK_FALSE(d.has("shortcuts"));
}
