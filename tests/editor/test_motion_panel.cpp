// The motion panel: a hinge fitted to bones, keys, a column of a table; files that are dropped on the window.
#include "editor/dialogs/dialogs.hpp"
#include "editor/driver.hpp"
#include "editor/dropped_file.hpp"
#include "editor/features.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/load_scene.hpp"
#include "fascicle/scene/embedded_scenes.hpp"
#include "fascicle/scene/line_muscles.hpp"
#include "support/data_dir.hpp"
#include "support/temp_dir.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <functional>
#include <numbers>
#include <thread>

using namespace fascicle;
using namespace fascicle::editor;
using fascicle::test::Driver;
namespace fs = std::filesystem;

namespace {

constexpr double degree = std::numbers::pi / 180;

void wait_for(Driver& d, const std::function<bool()>& done) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (!done() && std::chrono::steady_clock::now() < end) {
        d.frame();
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    REQUIRE(done());
    d.frame(3);
}

std::size_t steps(Driver& d) {
    return d.document().history().steps().size();
}

MotionEdit& motion(Driver& d) {
    return d.editor().features().motion;
}

const Timeline& timeline(Driver& d) {
    return d.document().scene().timeline;
}

void show_panel(Driver& d) {
    d.frame(3);
    d.key('M', {.ctrl = true});
    d.frame(2);
}

/// Types into a number, as a person who double-clicks it.
void type_number(Driver& d, const std::string& name, const std::string& text) {
    d.double_click(name);
    d.key(key_a, {.ctrl = true});
    d.type(text);
    d.key(key_enter);
    d.frame(2);
}

/// small_scene() before anybody moved anything.
Scene still_scene() {
    Scene scene = test::small_scene();
    scene.timeline = {};
    return scene;
}

void drop(Driver& d, const fs::path& file) {
    d.frame(2);
    d.editor().drop_files({file});
    d.frame();
    wait_for(d, [&] { return !d.editor().features().loader.reading(); });
}

fs::path write(const fs::path& file, const std::string& text) {
    write_file(file, text);
    return file;
}

} // namespace

TEST_CASE("The hinge of the hip is fitted where the scene has its centre", "[editor][ui][motion]") {
    Scene scene = make_embedded_scene("hip");
    scene.muscles.clear();
    const auto own = actions::hinge_motion(scene);
    REQUIRE(own);
    CHECK(own->there_and_back);
    const Vec3 centre = scene.timeline.hinge->centre;
    int femur = -1;
    for (int b = 0; b < static_cast<int>(scene.bones.size()); ++b)
        if (scene.timeline.moves(b))
            femur = b;
    REQUIRE(femur >= 0);
    const std::string name = scene.bones[std::size_t(femur)].name;
    scene.timeline = {};
    Driver d(scene);
    d.frame(3);
    d.click("timeline/motion"); // the empty timeline leads there
    CHECK(d.state().side_panel == "motion");
    d.click("motion/bone/" + name);
    motion(d).finish_fit();
    d.frame(3);
    REQUIRE(motion(d).ball());
    CHECK((timeline(d).hinge->centre - centre).norm() < 1.0); // mm
    CHECK(motion(d).ball()->rms < 0.5);
    CHECK(d.has("viewport/ball"));
    CHECK(d.has("viewport/joint_centre"));
    CHECK(d.document().history().undo_name() == "Fit joint centre");
    CHECK(steps(d) == 3);                             // the motion, the fit
    CHECK(timeline(d).hinge->axis == Vec3(-1, 0, 0)); // flexion counts positive
    type_number(d, "motion/angle", "40");
    CHECK(timeline(d).angle_rad(100) == Approx(40 * degree));
    // The knee goes forward.
    const Vec3 knee = timeline(d).hinge->centre + Vec3(0, 0, -400);
    CHECK(timeline(d).bone_pose(femur, 100).apply(knee).y() < knee.y() - 200);
    type_number(d, "motion/Out", "50");
    CHECK(timeline(d).last_frame == 250);
    type_number(d, "motion/centre/x", "12.5");
    CHECK(timeline(d).hinge->centre.x() == 12.5);
    CHECK_FALSE(motion(d).ball()); // it is no longer there
    d.click("motion/axis");
    d.click("motion/axis/Abduction, left");
    CHECK(timeline(d).hinge->axis == Vec3(0, -1, 0));
    d.click("motion/bone/" + name);
    CHECK_FALSE(timeline(d).moves(femur));
}

TEST_CASE("Dragging the angle previews the motion in one step, Esc takes it back", "[editor][ui][motion]") {
    Driver d;
    show_panel(d);
    const double before = timeline(d).angle_rad(30);
    const std::size_t count = steps(d);
    const ImVec2 at = d.middle("motion/angle");
    d.move_to(at);
    d.press();
    d.editor().input().mouse_move(at.x + 60, at.y);
    d.frame(3);
    CHECK(timeline(d).angle_rad(30) > before);
    CHECK(d.has("viewport/motion_preview"));
    REQUIRE(motion(d).preview() != nullptr);
    CHECK(motion(d).preview()->frame->index == 30); // at rest nothing would be seen
    CHECK(d.document().has_uncommitted_edits());
    d.key(key_escape);
    CHECK(timeline(d).angle_rad(30) == before);
    CHECK_FALSE(d.has("viewport/motion_preview"));
    d.release();
    CHECK(timeline(d).angle_rad(30) == before);
    CHECK(steps(d) == count);
    d.frame(20); // no double-click
    d.drag(d.middle("motion/angle"), {at.x + 80, at.y});
    CHECK(timeline(d).angle_rad(30) > before);
    CHECK(steps(d) == count + 1);
    CHECK(d.document().history().undo_name() == "Set joint angle");
    CHECK_FALSE(d.document().has_uncommitted_edits());
}

TEST_CASE("Joint centre and axis are picked on bones in the view, Esc ends picking", "[editor][ui][motion]") {
    Driver d;
    show_panel(d);
    d.click("motion/pick_centre");
    CHECK(d.state().tool == Tool::pick_point);
    CHECK(d.has("viewport/pick"));
    d.key(key_escape);
    d.frame();
    CHECK(d.state().tool == Tool::look);
    CHECK(motion(d).picking() == PickFor::nothing);
    const auto on_bone = [&](const Vec3& point) {
        const Rect area = d.rect("viewport");
        const auto p = d.state().camera.project(point, {double(area.width()), double(area.height())});
        REQUIRE(p);
        const ImVec2 at{area.min.x + static_cast<float>(p->x()), area.min.y + static_cast<float>(p->y())};
        d.move_to(at);
        d.press();
        d.release();
        d.frame(20);
    };
    const Vec3 before = timeline(d).hinge->centre;
    const Vec3 first = Vec3(10, 10, 20), second = Vec3(70, 10, 20); // inside of the two boxes
    d.click("motion/pick_centre");
    on_bone(first);
    CHECK(timeline(d).hinge->centre != before);
    const Vec3 p = timeline(d).hinge->centre;
    CHECK((p.array() > -0.01).all()); // on the first box
    CHECK(p.x() < 20.01);
    CHECK(d.state().tool == Tool::look);
    d.click("motion/pick_axis");
    on_bone(first);
    CHECK(motion(d).first_point());
    on_bone(second);
    CHECK(d.document().history().undo_name() == "Set joint axis");
    CHECK(timeline(d).hinge->axis.x() > 0.8);
    CHECK(timeline(d).hinge->centre.x() == Approx(40).margin(12));
}

TEST_CASE("Keys are set at the playhead, edited, moved and removed", "[editor][ui][motion]") {
    Driver d(still_scene());
    show_panel(d);
    d.click("motion/keys");
    d.click("motion/key_bone");
    d.click("motion/key_bone/turning");
    d.run()->compute(60);
    d.editor().state().playback.position = 20;
    d.frame(2);
    d.click("motion/insert");
    REQUIRE(timeline(d).bone_tracks.size() == 2);
    REQUIRE(timeline(d).bone_tracks[1].keys.size() == 2);
    CHECK_FALSE(timeline(d).hinge);
    type_number(d, "motion/key_angle", "30");
    CHECK(d.document().history().undo_name() == "Set key, turning");
    const Pose pose = timeline(d).bone_tracks[1].keys[1].pose;
    CHECK(actions::screw_of(pose, Vec3::Zero()).angle_rad == Approx(30 * degree));
    REQUIRE(timeline(d).hinge); // all that moves turns about one axis
    CHECK(std::abs(timeline(d).angle_rad(20)) == Approx(30 * degree));
    type_number(d, "motion/key_axis/y", "1");
    type_number(d, "motion/key_axis/x", "0");
    CHECK(actions::screw_of(timeline(d).bone_tracks[1].keys[1].pose, Vec3::Zero())
              .axis.isApprox(Vec3(0, 1, 0), 1e-6));
    for (const char* angle : {"0", "-25"}) // a pose forgets the axis of no turn, and the sign
        type_number(d, "motion/key_angle", angle);
    CHECK((timeline(d).bone_tracks[1].keys[1].pose.rotation -
           rotation_about(Vec3::Zero(), Vec3(0, 1, 0), -25 * degree).rotation)
              .norm() < 1e-6);
    type_number(d, "motion/key_angle", "30");
    type_number(d, "motion/key_slide", "5");
    CHECK(actions::screw_of(timeline(d).bone_tracks[1].keys[1].pose, Vec3::Zero()).slide == Approx(5));
    CHECK_FALSE(timeline(d).hinge); // a slide is no hinge
    d.click("motion/key_frame");
    d.key(key_a, {.ctrl = true});
    d.type("45");
    d.key(key_enter);
    d.frame(2);
    CHECK(timeline(d).bone_tracks[1].keys[1].frame == 45);
    type_number(d, "motion/key_angle", "200"); // half a turn and more from rest: the other way round
    CHECK(d.editor().log().unseen_errors() == 0);
    d.click("motion/remove");
    CHECK_FALSE(timeline(d).moves(1));
    d.click("motion/last_frame");
    d.key(key_a, {.ctrl = true});
    d.type("77");
    d.key(key_enter);
    d.frame(2);
    CHECK(timeline(d).last_frame == 77);
}

TEST_CASE("A column of a dropped .mot turns the hinge", "[editor][ui][motion]") {
    const test::TempDir folder;
    std::string text = "walk\nnRows=3\nnColumns=3\ninDegrees=yes\nendheader\ntime\tknee\thip_flexion_r\n";
    text += "0\t1\t10\n0.5\t1\t40\n1\t1\t10\n";
    Driver d;
    drop(d, write(folder.path() / "walk.mot", text));
    CHECK(d.state().side_panel == "motion");
    REQUIRE(motion(d).table != nullptr);
    CHECK(motion(d).column == 2);
    CHECK(motion(d).degrees);
    CHECK(motion(d).reversed); // the scene's hinge is about +x, where flexion counts negative
    motion(d).frames_per_second = 20;
    d.frame();
    d.click("motion/apply_column");
    CHECK(d.document().history().undo_name() == "Set motion from hip_flexion_r");
    CHECK(timeline(d).last_frame == 20);
    CHECK(timeline(d).angle_rad(10) == Approx(-30 * degree)); // counted from the first row
    CHECK(timeline(d).moves(1));
    const Pose expected = rotation_about(timeline(d).hinge->centre, timeline(d).hinge->axis, -30 * degree);
    CHECK((timeline(d).bone_pose(1, 10).rotation - expected.rotation).norm() < 1e-9);
    d.click("motion/from_rest");
    d.click("motion/reversed");
    d.click("motion/apply_column");
    CHECK(timeline(d).angle_rad(20) == Approx(10 * degree));
    CHECK(timeline(d).last_frame == 40);
    d.click("motion/radians");
    d.click(
        "motion/apply_column"); // 30 radians in ten frames are too fast, but below half a turn a frame: 10 rad before
    CHECK(d.editor().log().unseen_errors() <= 1);
    // The hinge can still be changed under the angles of the file.
    d.key(key_z, {.ctrl = true});
    d.click("motion/hinge");
    d.click("motion/there_and_back");
    CHECK(timeline(d).angle_rad(100) == Approx(30 * degree));
}

TEST_CASE("Every kind of dropped file goes to its place, others to a line in the log", "[editor][ui][load]") {
    const test::TempDir folder;
    const fs::path dir = folder.path();
    Driver d;
    d.frame(3);
    drop(d, write(dir / "outlines.csv",
                  "attachment,bone,x_mm,y_mm,z_mm\norigin,fixed,0,0,0\norigin,fixed,5,0,0\n"
                  "origin,fixed,5,5,0\n"));
    CHECK(d.document().scene().muscles[0].outlines.size() == 1);
    CHECK(d.document().history().undo_name() == "Load outlines, muscle");
    drop(d, write(dir / "motion.csv", "frame,bone,cx,cy,cz,ax,ay,az,angle_deg\n40,turning,0,0,0,1,0,0,30\n"));
    CHECK(timeline(d).last_frame == 40);
    CHECK(d.document().history().undo_name() == "Load motion");
    drop(d, write(dir / "fibres.vtk",
                  "# vtk DataFile Version 3.0\nfibres\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n"
                  "30 10 20 40 10 20 50 10 20\nLINES 1 4\n3 0 1 2\n"));
    wait_for(d, [&] { return d.document().scene().muscles[0].surface_fibres != nullptr; });
    CHECK_FALSE(d.editor().dialogs().mesh.is_open());
    CHECK(d.document().history().undo_name() == "Load surface fibres, muscle");
    const std::size_t count = steps(d);
    const int errors = d.editor().log().unseen_errors();
    drop(d, write(dir / "bad.json", "{ \"no\": 1 }"));
    drop(d, write(dir / "bad.osim", "<OpenSimDocument"));
    drop(d, write(dir / "bad.mot", "nothing"));
    drop(d, write(dir / "table.csv", "a,b\n1,2\n"));
    drop(d, write(dir / "letter.txt", "Dear reader"));
    drop(d, dir / "missing.osim");
    CHECK(d.editor().log().unseen_errors() == errors + 6);
    CHECK(steps(d) == count); // the scene is as it was
    for (const Message& message : d.editor().log().messages())
        CHECK(message.text.find('\n') == std::string::npos);
    std::string why;
    CHECK(kind_of_file(dir / "x.fascicle", why) == FileKind::project);
    CHECK(kind_of_file(write(dir / "model.xml", "<?xml?><OpenSimDocument Version=\"1\">"), why) ==
          FileKind::model);
    CHECK(kind_of_file(write(dir / "odd", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), why) == FileKind::mesh);
    CHECK(why.empty());
}

TEST_CASE("Files for a muscle are loaded by menu and dialog, Esc loads nothing", "[editor][ui][load]") {
    const test::TempDir folder;
    const fs::path file =
        write(folder.path() / "o.csv", "attachment,bone,x_mm,y_mm,z_mm\norigin,fixed,0,0,0\n"
                                       "origin,fixed,5,0,0\norigin,fixed,5,5,0\n");
    Driver d;
    d.frame(3);
    const char* const labels[] = {"Attachment outlines...", "Surface fibres...", "Fibre template...",
                                  "Line muscles..."};
    for (const char* label : labels) {
        d.click("menu/Scene");
        d.click(std::string("menu/") + label);
        d.frame(2);
        INFO(label);
        CHECK(d.has("load/load"));
        d.key(key_escape);
        d.frame(2);
        CHECK_FALSE(d.has("load/load"));
    }
    CHECK(steps(d) == 1);
    d.click("menu/Scene");
    d.click("menu/Attachment outlines...");
    d.frame(2);
    d.click("browser/path");
    d.key(key_a, {.ctrl = true});
    d.type(file.string());
    d.key(key_enter);
    d.frame(2);
    d.click("load/load");
    wait_for(d, [&] { return !d.editor().features().loader.reading(); });
    CHECK(d.document().scene().muscles[0].outlines.size() == 1);
    d.key(key_z, {.ctrl = true});
    CHECK(d.document().scene().muscles[0].outlines.empty());
}

TEST_CASE("Esc gives up what is being read", "[editor][ui][load]") {
    Driver d;
    d.frame(3);
    d.run()->compute(61);
    d.run()->finish();
    d.frame(2);
    auto& loader = d.editor().features().loader;
    loader.start("slow.osim", [](const JobControl& control) -> FileLoader::Apply {
        while (!control.cancelled())
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        throw Cancelled();
    });
    d.frame(2);
    CHECK(d.has("viewport/loading"));
    CHECK(d.editor().next_redraw());
    d.key(key_escape);
    d.frame(2);
    CHECK_FALSE(loader.reading());
    CHECK_FALSE(d.has("viewport/loading"));
    CHECK(d.editor().log().unseen_errors() == 0);
}

TEST_CASE("The motion panel draws every part, with nothing, with bones alone and with all",
          "[editor][panels][motion]") {
    const test::TempDir folder;
    for (const bool empty : {true, false}) {
        Driver d(empty ? Scene{} : still_scene());
        show_panel(d);
        CHECK(d.has("motion/hinge") == !empty);
        if (empty)
            continue;
        CHECK_FALSE(d.has("motion/angle")); // nothing moves yet
        for (const char* way : {"motion/keys", "motion/file", "motion/hinge"}) {
            d.click(way);
            d.frame(2);
        }
        d.click("motion/bone/turning"); // a box has no ball
        motion(d).finish_fit();
        d.frame(3);
        CHECK(d.has("motion/angle"));
        CHECK_FALSE(motion(d).fit_problem().empty());
    }
}

TEST_CASE("A model's joints move the bones of real data", "[editor][ui][motion]") {
    FASCICLE_NEED_DATA(data);
    const fs::path lhdl = data / "lhdl";
    SceneRequest request;
    request.bones = {lhdl / "right_iliac.vtk"};
    request.moving_bones = {lhdl / "femur.vtk"};
    request.angle_deg = -30;
    request.lines = lhdl / "LHDL_hip_r.osim";
    Driver d(load_scene(request).scene);
    REQUIRE(d.document().scene().line_muscles != nullptr);
    drop(d, lhdl / "LHDL_hip_flexion.mot");
    REQUIRE(motion(d).table != nullptr);
    motion(d).frames_per_second = 100;
    const auto& bodies = d.document().scene().line_muscles->model->skeleton.bodies;
    REQUIRE(motion(d).bone_of_body.size() == bodies.size());
    motion(d).from_rest = true;
    d.editor().run(Command::show_motion);
    const std::size_t count = steps(d);
    d.frame(3);
    d.click("motion/apply_model");
    REQUIRE(motion(d).table_problem == "");
    CHECK(steps(d) == count + 1);
    CHECK(timeline(d).last_frame == 35);
    const int femur = d.document().scene().bone_index("femur");
    CHECK(timeline(d).moves(femur));
    CHECK_FALSE(timeline(d).moves(d.document().scene().bone_index("right_iliac")));
    // From -10 to 60 degrees in the file, about an axis near the patient's left.
    const actions::Screw screw = actions::screw_of(timeline(d).bone_pose(femur, 35), Vec3::Zero());
    CHECK(screw.angle_rad == Approx(70 * degree).margin(1 * degree));
    CHECK(std::abs(screw.axis.x()) > 0.8);
}
