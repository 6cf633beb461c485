#include "editor/paint_driver.hpp"

using namespace fascicle;
using namespace fascicle::editor;
using fascicle::test::blades;
using fascicle::test::PaintDriver;

namespace {

const Vec3 middle(40, 0, 20);
constexpr Modifiers ctrl{.ctrl = true}, shift{.shift = true}, alt{.alt = true};

bool same_camera(const view::Camera& a, const view::Camera& b) {
    return a.eye() == b.eye() && a.pivot() == b.pivot();
}

} // namespace

TEST_CASE("Tab enters paint mode on the selected bone and leaves it, the panel comes to the front",
          "[editor][paint]") {
    PaintDriver d(blades(), "blade_l", false);
    d.state().selection = {};
    d.frame();
    d.key(key_tab);
    CHECK(d.state().tool == Tool::look);
    CHECK_FALSE(d.command_state(Command::paint_mode).reason.empty());
    d.select("blade_r");
    d.key(key_tab);
    d.wait();
    CHECK(d.state().tool == Tool::paint);
    CHECK(d.state().side_panel == "paint");
    CHECK(d.has("paint/tool/brush"));
    d.state().selection = {Selection::Kind::bone, "blade_l"}; // as the tree does
    d.wait();
    d.paint_at(middle);
    CHECK_FALSE(d.painted().empty());
    d.key(key_tab);
    CHECK(d.state().tool == Tool::look);
    CHECK(d.state().side_panel == "parameters");
    d.state().selection = {Selection::Kind::muscle, "gluteus"}; // its bone is known now
    d.frame();
    d.key(key_tab);
    CHECK(d.state().tool == Tool::paint);
    CHECK(d.state().selection == Selection{Selection::Kind::bone, "blade_l"});
}

TEST_CASE("A stroke paints what is under the brush, as one named step", "[editor][paint]") {
    PaintDriver d;
    const std::size_t before = d.steps();
    d.settings().radius_mm = 5;
    d.paint_along(Vec3(30, 0, 20), Vec3(50, 0, 20));
    CHECK(d.steps() == before + 1);
    CHECK(d.last_step() == "Paint insertion, gluteus");
    const std::vector<int> painted = d.painted();
    CHECK(painted.size() == Approx(288).epsilon(0.08)); // grid points in a stadium of radius 5 round 20 mm
    for (const int v : painted)
        CHECK(d.vertex(v).y() == 0);
    d.paint_along(Vec3(32, 0, 20), Vec3(48, 0, 20)); // all of it is painted already
    CHECK(d.steps() == before + 1);
    d.key(key_z, ctrl);
    CHECK(d.painted().empty());
    d.key(key_z, {.ctrl = true, .shift = true});
    CHECK(d.painted() == painted);
}

TEST_CASE("Ctrl erases and Shift smooths, as the tools of the keys 1 to 3 and E do", "[editor][paint]") {
    PaintDriver d;
    d.settings().radius_mm = 6;
    d.set([](const Vec3& p) { // a square with a spike on either side
        const double x = std::abs(p.x() - 40), z = std::abs(p.z() - 20);
        return p.y() == 0 && z < 12 && (x < 15 || (x < 22 && z < 1));
    });
    const std::size_t square = d.painted().size();
    d.hold(key_left_ctrl, ctrl);
    d.paint_at(middle);
    d.let_go(key_left_ctrl);
    CHECK(d.last_step() == "Erase insertion, gluteus");
    CHECK(d.painted().size() < square);
    d.key(key_z, ctrl);
    CHECK(d.painted().size() == square);
    d.hold(key_left_shift, shift);
    d.paint_at(Vec3(21, 0, 20));
    d.let_go(key_left_shift);
    CHECK(d.last_step() == "Smooth insertion, gluteus");
    d.key(key_z, ctrl);

    d.key(key_2);
    CHECK(d.settings().kind == PaintKind::eraser);
    d.paint_at(middle);
    CHECK(d.last_step() == "Erase insertion, gluteus");
    d.key(key_3);
    CHECK(d.settings().kind == PaintKind::smooth);
    d.paint_at(Vec3(59, 0, 20));
    CHECK(d.last_step() == "Smooth insertion, gluteus");
    d.key(key_e);
    CHECK(d.settings().kind == PaintKind::eraser);
    d.key(key_e);
    CHECK(d.settings().kind == PaintKind::smooth);
    d.key(key_1);
    CHECK(d.settings().kind == PaintKind::brush);
}

TEST_CASE("Esc during a stroke restores the area, then leaves the tool", "[editor][paint]") {
    PaintDriver d;
    const std::size_t before = d.steps();
    d.move_to(d.place(Vec3(30, 0, 20)));
    d.press();
    d.move_to(d.place(Vec3(35, 0, 20)));
    CHECK_FALSE(d.painted().empty());
    d.key(key_escape);
    CHECK(d.painted().empty());
    CHECK(d.state().tool == Tool::paint);
    d.move_to(d.place(Vec3(50, 0, 20))); // the button is still down
    CHECK(d.painted().empty());
    d.release();
    CHECK(d.steps() == before);
    CHECK_FALSE(d.document().has_uncommitted_edits());
    d.paint_at(middle);
    CHECK(d.steps() == before + 1);
    d.key(key_escape); // the job first: a run is under way
    CHECK(d.state().tool == Tool::paint);
    CHECK_FALSE(d.editor().runs().running());
    d.key(key_escape);
    CHECK(d.state().tool == Tool::look);
    CHECK_FALSE(d.painted().empty());
    CHECK(d.state().selection.name == "blade_l");
    d.key(key_escape); // the run, which the test lets go on
    d.key(key_escape);
    CHECK(d.state().selection == Selection{});
}

TEST_CASE("Undo during a stroke takes the stroke back and other keys wait", "[editor][paint]") {
    PaintDriver d;
    const std::size_t before = d.steps();
    d.move_to(d.place(middle));
    d.press();
    d.key(key_delete);
    CHECK(d.document().scene().bones.size() == 3);
    d.key(key_o);
    CHECK(d.settings().label == AttachmentKind::insertion);
    d.key(key_z, ctrl);
    CHECK(d.painted().empty());
    d.move_to(d.place(Vec3(50, 0, 20)));
    d.release();
    CHECK(d.painted().empty());
    CHECK(d.steps() == before);
}

TEST_CASE("Camera gestures never paint and keep the selection", "[editor][paint]") {
    PaintDriver d;
    const std::size_t before = d.steps();
    const view::Camera front = d.state().camera;
    const auto moved_without_paint = [&] {
        CHECK_FALSE(same_camera(d.state().camera, front));
        CHECK(d.steps() == before);
        CHECK(d.painted().empty());
        CHECK(d.state().selection.name == "blade_l");
        d.state().camera = front;
        d.frame(20);
    };
    const Vec3 from(30, 0, 20), to(50, 0, 30);
    d.drag(d.place(from), d.place(to), 2);
    moved_without_paint();
    d.drag(d.place(from), d.place(to), 1);
    moved_without_paint();
    d.hold(key_left_alt, alt);
    d.drag(d.place(from), d.place(to));
    d.let_go(key_left_alt);
    moved_without_paint();
    d.hold(key_v, {});
    d.drag(d.place(from), d.place(to));
    d.let_go(key_v);
    moved_without_paint();
    d.drag(d.place(Vec3(0, 0, -10)), d.place(Vec3(30, 0, -12))); // empty background
    moved_without_paint();
    d.wheel("viewport", 2);
    moved_without_paint();
    d.move_to(d.place(Vec3(0, 0, -10))); // a click beside the bone
    d.press();
    d.release();
    CHECK(d.state().selection.name == "blade_l");
    CHECK(d.state().tool == Tool::paint);
}

TEST_CASE("Brackets and Shift with the wheel change the radius by a fifth", "[editor][paint]") {
    PaintDriver d;
    const view::Camera front = d.state().camera;
    CHECK(d.settings().radius_text() == "8.0 mm");
    d.key(key_right_bracket);
    CHECK(d.settings().radius_mm == Approx(9.6));
    d.key(key_left_bracket);
    CHECK(d.settings().radius_mm == Approx(8));
    d.move_to(d.place(middle));
    d.hold(key_left_shift, shift);
    d.editor().input().wheel(0, 1);
    d.frame(2);
    CHECK(d.settings().radius_mm == Approx(9.6));
    d.editor().input().wheel(-1, 0); // some systems make it a sideways wheel
    d.frame(2);
    CHECK(d.settings().radius_mm == Approx(8));
    d.let_go(key_left_shift);
    CHECK(same_camera(d.state().camera, front));
    d.click("paint/pixels");
    CHECK(d.settings().radius_text() == "40 px");
    d.key(key_right_bracket);
    CHECK(d.settings().radius_px == Approx(48));
}

TEST_CASE("The radius is a length on the surface, whatever the zoom, in pixel mode one on the screen",
          "[editor][paint]") {
    PaintDriver d;
    d.settings().radius_mm = 6;
    d.paint_at(middle);
    const std::vector<int> far = d.painted();
    d.key(key_z, ctrl);
    d.wheel("viewport", 3);
    d.paint_at(middle);
    const std::vector<int> close = d.painted(); // the pointer's pixel is another place of the surface
    std::vector<int> differing;
    std::set_symmetric_difference(far.begin(), far.end(), close.begin(), close.end(),
                                  std::back_inserter(differing));
    CHECK(far.size() > 60);
    CHECK(differing.size() < far.size() / 5);
    d.key(key_z, ctrl);
    d.click("paint/pixels");
    d.settings().radius_px = 30;
    d.paint_at(middle);
    const std::size_t near = d.painted().size();
    d.key(key_z, ctrl);
    d.wheel("viewport", -4);
    d.paint_at(middle);
    CHECK(d.painted().size() > near);
}

TEST_CASE("What would change is known before the click, and the cursor lies on the surface",
          "[editor][paint]") {
    PaintDriver d;
    d.move_to(d.place(middle));
    CHECK(d.tool().cursor_shown());
    const std::vector<int> promised = d.tool().preview();
    CHECK(promised.size() > 150);
    CHECK(d.paint().highlights() != nullptr);
    d.press();
    d.release();
    CHECK(d.painted() == promised);
    d.frame();
    CHECK(d.tool().preview().empty()); // all painted now
    d.hold(key_left_ctrl, ctrl);
    CHECK(d.tool().preview() == promised);
    d.let_go(key_left_ctrl);
    d.move_to(d.place(Vec3(0, 0, -10)));
    CHECK_FALSE(d.tool().cursor_shown());
    CHECK(d.paint().highlights() == nullptr);
}

TEST_CASE(
    "Connected paint never reaches the far side of a blade, a sphere does, a circle only through the bone",
    "[editor][paint]") {
    PaintDriver d;
    const Vec3 rim(12, 0, 20);
    d.paint_at(rim);
    CHECK(d.painted().size() > 60);
    CHECK(d.on_back(d.painted()) == 0);
    d.key(key_z, ctrl);
    d.click("paint/reach");
    d.click("paint/reach/sphere");
    d.paint_at(rim);
    CHECK(d.on_back(d.painted()) > 50);
    d.key(key_z, ctrl);
    d.click("paint/reach");
    d.click("paint/reach/screen");
    d.paint_along(rim, middle);
    CHECK(d.painted().size() > 300);
    CHECK(d.on_back(d.painted()) == 0);
    d.key(key_z, ctrl);
    d.click("paint/through");
    d.paint_at(middle);
    CHECK(d.on_back(d.painted()) > 100);
}

TEST_CASE("O and I choose the label, a lock keeps it from being painted over", "[editor][paint]") {
    PaintDriver d;
    d.key(key_o);
    d.paint_at(middle);
    CHECK(d.last_step() == "Paint origin, gluteus");
    const std::vector<int> origin = d.painted(AttachmentKind::origin);
    CHECK(origin.size() > 100);
    d.key(key_i);
    d.click("paint/lock/origin");
    d.paint_along(Vec3(28, 0, 20), Vec3(52, 0, 20));
    CHECK(d.painted(AttachmentKind::origin) == origin);
    const std::size_t around = d.painted().size();
    CHECK(around > 100);
    d.key(key_o); // the locked label itself
    const std::size_t before = d.steps();
    d.paint_at(Vec3(60, 0, 20));
    CHECK(d.steps() == before);
    CHECK(d.editor().log().messages().back().text == "Origin is locked.");
    d.key(key_i);
    d.click("paint/lock/origin");
    d.paint_along(Vec3(28, 0, 20), Vec3(52, 0, 20));
    CHECK(d.painted(AttachmentKind::origin).empty());
    CHECK(d.painted().size() == around + origin.size());
}

TEST_CASE("M paints the pair of a bone too, as one step", "[editor][paint]") {
    PaintDriver d;
    d.key(key_m);
    CHECK(d.settings().mirror);
    d.wait();
    const std::size_t before = d.steps();
    d.paint_along(Vec3(20, 0, 10), Vec3(30, 0, 10));
    CHECK(d.steps() == before + 1);
    const std::vector<int> left = d.painted(), right = d.painted(AttachmentKind::insertion, 1);
    CHECK(left.size() > 100);
    CHECK(right.size() == Approx(left.size()).margin(6));
    double mean = 0;
    for (const int v : right)
        mean += d.vertex(v, 1).x() / double(right.size());
    CHECK(mean == Approx(-25).margin(1));
    d.key(key_z, ctrl);
    CHECK(d.painted(AttachmentKind::insertion, 1).empty());
    d.key(key_6); // fills and lassos are mirrored as sets of vertices
    d.move_to(d.place(Vec3(20, 0, 10)));
    d.press();
    for (const Vec3& p : {Vec3(30, 0, 10), Vec3(30, 0, 20), Vec3(20, 0, 20)})
        d.move_to(d.place(p));
    d.release();
    CHECK(d.painted(AttachmentKind::insertion, 1).size() == d.painted().size());
    d.key(key_m);
    d.key(key_tab);
    d.select("block"); // no side in its name: its own other half
    d.key(key_tab);
    d.key(key_m);
    d.key(key_1);
    d.wait();
    d.settings().radius_mm = 4;
    d.paint_at(Vec3(-7, 0, 65));
    double both = 0;
    const std::vector<int> block = d.painted(AttachmentKind::insertion, 2);
    for (const int v : block)
        both += d.vertex(v, 2).x();
    CHECK(block.size() > 10);
    CHECK(both == Approx(0).margin(1e-9));
}

TEST_CASE("A bone without its other side cannot be mirrored", "[editor][paint]") {
    Scene scene = blades();
    scene.bones[1].name = "other";
    PaintDriver d(std::move(scene));
    d.key(key_m);
    CHECK_FALSE(d.settings().mirror);
    CHECK(d.command_state(Command::paint_mirror).reason == "the scene has no bone 'blade_r'");
}

TEST_CASE("Painting works on a bone that has moved, at the place that is seen", "[editor][paint]") {
    PaintDriver d(blades(true));
    d.run()->compute(31);
    d.state().playback.position = 20;
    d.frame(3);
    const Pose pose = d.document().scene().timeline.bone_pose(0, 20);
    REQUIRE_FALSE(pose.is_identity());
    d.settings().radius_mm = 5;
    d.paint_at(pose.apply(Vec3(30, 0, 12)));
    const std::vector<int> painted = d.painted();
    REQUIRE(painted.size() > 50);
    Vec3 mean = Vec3::Zero();
    for (const int v : painted)
        mean += d.vertex(v) / double(painted.size());
    CHECK((mean - Vec3(30, 0, 12)).norm() < 0.7);
}

TEST_CASE("A run starts again after a stroke, never during one", "[editor][paint]") {
    PaintDriver d;
    d.settle();
    const int before = d.runs_started();
    d.move_to(d.place(Vec3(30, 0, 20)));
    d.press();
    d.move_to(d.place(Vec3(50, 0, 20)));
    d.settle();
    CHECK(d.runs_started() == before);
    d.release();
    d.run()->finished = true;
    d.settle();
    d.settle();
    CHECK(d.runs_started() == before + 1);
    CHECK(d.run()->recording()->scene().muscles[0].areas == d.document().scene().muscles[0].areas);
}

TEST_CASE("A large bone is prepared beside the interface and says so", "[editor][paint]") {
    Scene scene = blades();
    scene.bones[0].mesh = std::make_shared<const TriMesh>(test::sphere(20, 6, Vec3(40, 20, 20)));
    PaintDriver d(std::move(scene), "blade_l", false);
    d.key(key_tab);
    if (d.paint().preparing()) { // a quick machine is done at once
        CHECK(d.has("viewport/paint_badge"));
        CHECK(d.editor().next_redraw());
        const std::size_t before = d.steps();
        d.paint_at(Vec3(40, 0, 20));
        if (d.paint().preparing())
            CHECK(d.steps() == before);
    }
    d.wait();
    d.paint_at(Vec3(40, 0, 20));
    CHECK_FALSE(d.painted().empty());
}
