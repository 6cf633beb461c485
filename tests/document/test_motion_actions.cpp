#include "fascicle/document/actions/import_actions.hpp"
#include "fascicle/document/actions/mesh_actions.hpp"
#include "fascicle/document/actions/timeline_actions.hpp"
#include "support/shapes.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <numbers>

using namespace fascicle;

namespace {

constexpr double degree = std::numbers::pi / 180;

Scene two_bones() {
    Scene scene;
    for (const char* name : {"pelvis", "femur"})
        scene.bones.push_back({name, std::make_shared<const TriMesh>(test::box(10, 10, 10)), {}});
    return scene;
}

} // namespace

TEST_CASE("A pose is a screw and back again", "[document][motion_actions]") {
    const Pose turn = rotation_about(Vec3(1, 2, 3), Vec3(1, -2, 0.5), 1.2);
    Pose slid = turn;
    slid.translation += 4 * Vec3(1, -2, 0.5).normalized();
    Pose shift;
    shift.translation = Vec3(0, 3, 4);
    for (const Pose& pose : {turn, slid, shift, Pose{}, turn.inverse()}) {
        const actions::Screw screw = actions::screw_of(pose, Vec3(5, 5, 5));
        const Pose again = actions::pose_of(screw);
        CHECK((again.rotation - pose.rotation).norm() < 1e-12);
        CHECK((again.translation - pose.translation).norm() < 1e-12);
    }
    CHECK(actions::screw_of(slid, Vec3::Zero()).slide == Approx(4));
    CHECK(actions::screw_of(shift, Vec3::Zero()).slide == Approx(5));
    CHECK(actions::screw_of(shift, Vec3::Zero()).angle_rad == 0);
    CHECK_THROWS_AS(actions::pose_of(actions::Screw{Vec3::Zero(), Vec3::Zero(), 1, 0}), std::exception);
}

TEST_CASE("The motion about a joint is read back from the timeline", "[document][motion_actions]") {
    Document document(two_bones());
    CHECK_FALSE(actions::hinge_motion(document.scene()));
    const Hinge hinge{Vec3(1, 2, 3), Vec3(-1, 0, 0)};
    actions::set_hinge(document, hinge, 100 * degree, {40, 30, 5}, {1});
    const auto motion = actions::hinge_motion(document.scene());
    REQUIRE(motion);
    CHECK(motion->there_and_back);
    CHECK(motion->angle_rad == 100 * degree);
    CHECK(motion->phases.out == 40);
    CHECK(motion->phases.back == 30);
    CHECK(motion->phases.rest == 5);
    CHECK(motion->moving == std::vector<int>{1});

    actions::set_hinge_angles(document, hinge, {{0, 0}, {10, 1}, {20, -1}, {30, 0.5}}, {1},
                              "Set motion from q");
    const auto course = actions::hinge_motion(document.scene());
    REQUIRE(course);
    CHECK_FALSE(course->there_and_back);
    actions::HingeMotion moved = *course; // the angles stay under another axis
    moved.hinge.axis = Vec3(0, 0, 1);
    actions::edit_hinge(document, moved);
    CHECK(actions::commit_motion(document));
    CHECK(document.scene().timeline.angle_rad(20) == -1);
    CHECK(document.scene().timeline.bone_pose(1, 20).rotation.isApprox(
        Eigen::AngleAxisd(-1, Vec3::UnitZ()).toRotationMatrix()));
    actions::edit_hinge(document, moved);
    CHECK_FALSE(actions::commit_motion(document)); // nothing changed

    const auto version = document.version();
    CHECK_THROWS_AS(actions::set_hinge_angles(document, hinge, {{0, 0}, {1, 4}}, {1}, "q"), std::exception);
    CHECK_THROWS_AS(actions::set_hinge_angles(document, hinge, {{0, 1}, {1, 1}}, {1}, "q"), std::exception);
    CHECK(document.version() == version);
}

TEST_CASE("Keys keep, find and lose the joint angle", "[document][motion_actions]") {
    Document document(two_bones());
    const Vec3 centre(5, 5, 0);
    const auto turn = [&](double degrees) { return rotation_about(centre, Vec3::UnitX(), degrees * degree); };
    actions::set_pose_key(document, 1, 20, turn(60));
    actions::set_pose_key(document, 1, 40, turn(-30));
    const Timeline& timeline = document.scene().timeline;
    REQUIRE(timeline.hinge);
    const double sign = timeline.hinge->axis.x() > 0 ? 1 : -1;
    CHECK(sign * timeline.angle_rad(20) == Approx(60 * degree));
    CHECK(sign * timeline.angle_rad(40) == Approx(-30 * degree));
    CHECK(timeline.bone_tracks[1].keys.size() == 3); // rest, too
    actions::move_pose_key(document, 1, 2, 50.5);
    CHECK(timeline.bone_tracks[1].keys[2].frame == 50.5);
    CHECK_THROWS_AS(actions::move_pose_key(document, 1, 2, 20), std::exception); // taken
    CHECK_THROWS_AS(actions::set_pose_key(document, 1, 0, turn(1)), std::exception);
    const std::size_t steps = document.history().steps().size();
    actions::set_pose_key(document, 1, 21, turn(179));
    CHECK_THROWS_WITH(actions::set_pose_key(document, 1, 22, turn(-1)), Catch::Contains("femur"));
    CHECK(document.history().steps().size() == steps + 1);
    actions::set_pose_key(document, 0, 10, rotation_about(Vec3::Zero(), Vec3::UnitY(), 0.1));
    CHECK_FALSE(timeline.hinge); // two bones about two axes
    while (timeline.bone_tracks[1].keys.size() > 1)
        actions::remove_pose_key(document, 1, 1);
    CHECK(timeline.bone_tracks[1].keys.empty());
    CHECK(timeline.hinge); // one moves again
    CHECK(actions::set_last_frame(document, 12));
    CHECK_FALSE(actions::set_last_frame(document, 12));
    CHECK_THROWS_AS(actions::set_last_frame(document, 0), std::exception);
}

TEST_CASE("A batch of meshes is one step or none", "[document][mesh_actions]") {
    Document document(two_bones());
    const auto box = std::make_shared<const TriMesh>(test::box(1, 2, 3));
    TriMesh holed = *box;
    holed.triangles.pop_back();
    const auto open = std::make_shared<const TriMesh>(holed);
    using actions::MeshRole;
    const auto one = [](const char* path, const char* name, MeshRole role, const MeshPtr& mesh,
                        const char* hash) {
        return actions::NewMesh{path, name, role, false, mesh, hash, check_mesh(*mesh)};
    };
    CHECK_THROWS_WITH(actions::add_meshes(document, {one("a.obj", "", MeshRole::bone, box, "h"),
                                                     one("b.obj", "", MeshRole::muscle, open, "")}),
                      Catch::Contains("b.obj"));
    CHECK(document.history().steps().size() == 1);
    CHECK_FALSE(document.has_uncommitted_edits());
    actions::add_meshes(document, {});
    CHECK(document.history().steps().size() == 1);
    actions::add_meshes(document, {one("a.obj", "", MeshRole::bone, open, "h"),
                                   one("c.obj", "femur", MeshRole::muscle, box, "")});
    CHECK(document.history().undo_name() == "Add 2 meshes");
    CHECK(document.scene().bones[2].name == "a");
    CHECK(document.scene().bones[2].source.path == "a.obj");
    CHECK(document.scene().bones[2].source.hash == "h");
    CHECK(document.scene().muscles[0].name == "femur 2");
    CHECK(document.scene().fibre_templates != nullptr);
    actions::add_meshes(document, {one("d.obj", "", MeshRole::bone, box, "")});
    CHECK(document.history().undo_name() == "Add bone d");
}
