#include "fascicle/base/error.hpp"
#include "fascicle/scene/line_muscles.hpp"
#include "support/line_model.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

using namespace fascicle;
using namespace fascicle::test;
using Catch::Matchers::Contains;

namespace {

LineMuscles place(const Scene& scene, const LineModel& model, std::string* said = nullptr) {
    std::vector<std::string> notes;
    LineMuscles lines =
        place_line_muscles(std::make_shared<const LineModel>(model), scene, "arm.osim", notes);
    if (said != nullptr)
        for (const std::string& note : notes)
            *said += note + '\n';
    return lines;
}

} // namespace

TEST_CASE("line muscles: bodies go with bones of their name, with or without a side", "[scene][lines]") {
    std::string said;
    const LineMuscles lines = place(arm_scene(0.5), arm_model(), &said);
    CHECK(lines.bone_of_body == std::vector<std::string>{"", "base", "arm"});
    CHECK_THAT(said, Contains("the ground frame of the model is the scene's"));
    CHECK_THAT(said, Contains("body base goes with bone base, by name"));
    CHECK_THAT(said, Contains("body arm_r goes with bone arm, by name"));
    CHECK_THAT(said, Contains("coordinate elbow_q turns with the joint, in its sense"));
    for (const Pose& pose : lines.rest)
        CHECK(pose.is_identity());
    CHECK(lines.rest_values == std::vector<double>{0.0});
}

TEST_CASE("line muscles: a bone of the exact name goes before one without its side", "[scene][lines]") {
    Scene scene = arm_scene(0.5);
    scene.bones.push_back(scene.bones[1]);
    scene.bones.back().name = "arm_r";
    CHECK(place(scene, arm_model()).bone_of_body[2] == "arm_r");
}

TEST_CASE("line muscles: without a name the nearest bone within 5 mm counts, else one that does not move",
          "[scene][lines]") {
    Scene scene = arm_scene(0.5);
    scene.bones[0].name = "scapula";
    scene.bones[1].name = "ulna";
    std::string said;
    CHECK(place(scene, arm_model(), &said).bone_of_body == std::vector<std::string>{"", "scapula", "ulna"});
    CHECK_THAT(said, Contains("body arm_r goes with bone ulna, the nearest to the ends of its muscles"));

    TriMesh far = *scene.bones[1].mesh;
    for (Vec3& p : far.positions)
        p.x() -= 20; // its end is then 15 mm away
    scene.bones[1].mesh = std::make_shared<const TriMesh>(far);
    said.clear();
    CHECK(place(scene, arm_model(), &said).bone_of_body ==
          std::vector<std::string>{"", "scapula", "scapula"});
    CHECK_THAT(said, Contains("body arm_r goes with bone scapula, for want of"));
    CHECK_THAT(said, Contains("no coordinate turns moving bones"));
}

TEST_CASE("line muscles: a model whose bodies were digitised as they lie is found, and its posture",
          "[scene][lines]") {
    // The arm's joint frame is turned by 0.4 in the arm: at 0 the model's arm stands 0.4 away from where it was digitised.
    LineModel model = arm_model();
    model.skeleton.joints[1].child_frame = rotation_about(Vec3::Zero(), Vec3::UnitZ(), 0.4);
    std::string said;
    const LineMuscles lines = place(arm_scene(0.5), model, &said);
    CHECK_THAT(said, Contains("the frame of every body is the scene's"));
    CHECK_THAT(said, Contains("the scene's rest is the model's posture elbow_q 22.9 degrees"));
    REQUIRE(lines.rest_values.size() == 1);
    CHECK(lines.rest_values[0] == Approx(0.4).margin(1e-9));
    for (const Pose& pose : lines.rest)
        CHECK(pose.is_identity());
    // The same where the ground of the model is elsewhere.
    model.skeleton.joints[0].parent_frame.translation = Vec3(1, 2, 3);
    CHECK(place(arm_scene(0.5), model).rest_values[0] == Approx(0.4).margin(1e-9));
}

TEST_CASE("line muscles: a model may stand in the scene by the frame of one body", "[scene][lines]") {
    LineModel model = arm_model();
    model.skeleton.joints[0].parent_frame =
        rotation_about(Vec3(1, 0, 0), Vec3(1, 2, 3), 0.7); // base in ground
    model.skeleton.coordinates[0].default_value = 0.3;
    model.muscles[0].points.back().location =
        rotation_about(Vec3::Zero(), Vec3::UnitZ(), -0.3).apply(Vec3(0, 0.05, 0));
    std::string said;
    const LineMuscles lines = place(arm_scene(-0.5), model, &said);
    CHECK_THAT(said, Contains("the frame of body base is the scene's"));
    CHECK(lines.rest_values == std::vector<double>{0.3});
    CHECK((lines.rest[2].apply(model.muscles[0].points.back().location) - Vec3(0, 0.05, 0)).norm() < 1e-12);
    CHECK(hinge_coordinate(lines, arm_scene(-0.5)).per_angle == Approx(1));
}

TEST_CASE("line muscles: the coordinate that turns with the joint, its sense, and when it can't be told",
          "[scene][lines]") {
    Scene scene = arm_scene(0.5);
    LineModel model = arm_model();
    const LineMuscles lines = place(scene, model);
    const LineCoordinate same = hinge_coordinate(lines, scene);
    CHECK(same.index == 0);
    CHECK(same.per_angle == Approx(1));
    scene.timeline.hinge->axis *= -3;
    CHECK(hinge_coordinate(lines, scene).per_angle == Approx(-1));

    std::string note;
    scene.timeline.hinge->axis = Vec3(0, 1, 1); // 45 degrees off
    CHECK(hinge_coordinate(lines, scene, &note).index == -1);
    CHECK_THAT(note, Contains("no coordinate turns"));
    scene.timeline.hinge.reset();
    CHECK(hinge_coordinate(lines, scene, &note).index == -1);
    CHECK_THAT(note, Contains("no single joint"));

    scene = arm_scene(0.5);
    model.skeleton.coordinates.push_back({"twist", CoordinateKind::rotational, 0, 0, 0, false, false});
    model.skeleton.joints[1].rotations.push_back(
        {Vec3::UnitZ(), {{{1, 1.0}}, JointFunction::linear(-0.5, 0)}});
    CHECK(hinge_coordinate(place(scene, model), scene, &note).index == -1);
    CHECK_THAT(note, Contains("several coordinates turn"));
    model.skeleton.coordinates[0].locked = true;
    const LineCoordinate geared = hinge_coordinate(place(scene, model), scene);
    CHECK(geared.index == 1);
    CHECK(geared.per_angle == Approx(-2)); // half a turn for each of its own, the other way
}

TEST_CASE("line muscles: what belongs to no bone, or lies elsewhere, is refused", "[scene][lines]") {
    const auto refused = [](const Scene& scene, const LineModel& model, const std::string& part) {
        CHECK_THROWS_WITH(place(scene, model), Contains("arm.osim") && Contains(part));
    };
    Scene scene = arm_scene(0.5);
    LineModel empty = arm_model();
    empty.muscles.clear();
    refused(scene, empty, "no muscles");
    Scene bare = scene;
    bare.bones.clear();
    refused(bare, arm_model(), "no bones");

    LineModel away = arm_model();
    for (PathPoint& point : away.muscles[0].points)
        point.location += Vec3(0.3, 0, 0);
    refused(scene, away, "mm from the bones in the mean");
    for (PathPoint& point : away.muscles[0].points)
        point.location -= Vec3(0.28, 0, 0);
    scene.bones[0].name = "a";
    scene.bones[1].name = "b";
    refused(scene, away, "(base, arm_r) belongs to a bone");
}
