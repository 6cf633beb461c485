#include "fascicle/document/actions/fibre_actions.hpp"
#include "fascicle/document/actions/mesh_actions.hpp"
#include "fascicle/document/actions/parameter_actions.hpp"
#include "fascicle/document/actions/scene_actions.hpp"
#include "fascicle/document/actions/timeline_actions.hpp"

#include "fascicle/base/error.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;

namespace {

MeshPtr some_mesh() {
    auto mesh = std::make_shared<TriMesh>();
    mesh->positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh->triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    return mesh;
}

Document three_bones() {
    Scene scene;
    for (const char* name : {"a", "b", "c"})
        scene.bones.push_back({name, some_mesh(), {}});
    Muscle muscle;
    muscle.name = "m";
    muscle.mesh = some_mesh();
    muscle.attachments = {{AttachmentKind::origin, 0, {0}},
                          {AttachmentKind::insertion, 1, {1}},
                          {AttachmentKind::unknown, 2, {2}}};
    scene.muscles.push_back(muscle);
    return Document(std::move(scene));
}

std::size_t steps(const Document& document) {
    return document.history().steps().size();
}

} // namespace

TEST_CASE("A parameter drag is one step, and none when it comes back", "[document][actions]") {
    Document document{Scene{}};
    for (const double value : {0.1, 0.2, 0.3})
        actions::edit_parameter(document, "solver.stiffness", value);
    CHECK(steps(document) == 1);
    CHECK(document.scene().parameters.get("solver.stiffness") == 0.3);
    CHECK(actions::commit_parameter(document, "solver.stiffness"));
    CHECK(steps(document) == 2);
    CHECK(document.history().undo_name() == "Set Edge stiffness");
    actions::edit_parameter(document, "solver.stiffness", 0.7);
    actions::edit_parameter(document, "solver.stiffness", 0.3);
    CHECK_FALSE(actions::commit_parameter(document, "solver.stiffness"));
    CHECK(steps(document) == 2);
    CHECK_FALSE(document.has_uncommitted_edits());
    REQUIRE(document.undo());
    CHECK(document.scene().parameters.get("solver.stiffness") == 0.9);
    CHECK_FALSE(document.scene().parameters.edited("solver.stiffness"));
}

TEST_CASE("A bad parameter value leaves the document as it was", "[document][actions]") {
    Document document{Scene{}};
    CHECK_THROWS_AS(actions::set_parameter(document, "solver.stiffness", 7), Error);
    CHECK_THROWS_AS(actions::edit_parameter(document, "no.such", 0), Error);
    CHECK_THROWS_AS(actions::set_method(document, "magic"), Error);
    CHECK(steps(document) == 1);
    CHECK_FALSE(document.has_uncommitted_edits());
    CHECK_FALSE(document.dirty());
}

TEST_CASE("The method brings its defaults, edited values stay", "[document][actions]") {
    Document document{Scene{}};
    CHECK(actions::set_parameter(document, "solver.stiffness", 0.5));
    CHECK(actions::set_method(document, "classic"));
    CHECK(document.scene().parameters.get("solver.bending") == 0.9);
    CHECK(document.scene().parameters.get("solver.stiffness") == 0.5);
    CHECK(actions::reset_parameter(document, "solver.stiffness"));
    CHECK_FALSE(actions::reset_parameter(document, "solver.stiffness"));
    CHECK(actions::reset_parameter(document, "solver.method"));
    CHECK(document.scene().parameters.get("solver.bending") == 0.3);
    CHECK(actions::set_parameter(document, "solver.pressure", 1.5));
    CHECK(actions::reset_all_parameters(document));
    CHECK(document.scene().parameters.get("solver.pressure") == 1);
    const std::size_t before = steps(document);
    CHECK_FALSE(actions::reset_all_parameters(document));
    CHECK(steps(document) == before);
}

TEST_CASE("What a scene brings in place of a method's defaults comes back with the method",
          "[document][actions]") {
    Scene scene;
    bring_defaults(scene.parameters, {{"solver.stiffness", 0.2}, {"solver.damping", 25}});
    Document document{std::move(scene)};
    const auto value = [&](const char* key) { return document.scene().parameters.get(key); };
    REQUIRE(value("solver.stiffness") == 0.2);
    CHECK(actions::set_method(document, "classic"));
    CHECK(value("solver.stiffness") != 0.2);
    CHECK(actions::set_method(document, "xpbd"));
    CHECK(value("solver.stiffness") == 0.2);
    CHECK(value("solver.damping") == 25);
    CHECK(actions::set_method(document, "classic"));
    CHECK(actions::set_parameter(document, "solver.stiffness", 0.5));
    CHECK(actions::reset_all_parameters(document));
    CHECK(document.scene().parameters.get_choice("solver.method") == "xpbd");
    CHECK(value("solver.stiffness") == 0.2);
    CHECK_FALSE(document.scene().parameters.edited("solver.stiffness"));
    CHECK_FALSE(actions::reset_all_parameters(document));
}

TEST_CASE("Names are unique over bones and muscles", "[document][actions]") {
    Document document{Scene{}};
    CHECK(actions::add_bone(document, {"femur", some_mesh(), {}}) == 0);
    CHECK(actions::add_bone(document, {"femur", some_mesh(), {}}) == 1);
    Muscle muscle;
    muscle.name = "femur";
    muscle.mesh = some_mesh();
    CHECK(actions::add_muscle(document, muscle) == 0);
    CHECK(document.scene().bones[1].name == "femur 2");
    CHECK(document.scene().muscles[0].name == "femur 3");
    CHECK_FALSE(actions::rename_muscle(document, 0, "femur 2"));
    CHECK_FALSE(actions::rename_muscle(document, 0, ""));
    CHECK(actions::rename_muscle(document, 0, "vastus"));
    CHECK(actions::rename_bone(document, 0, "tibia"));
    CHECK(steps(document) == 6);
    actions::remove_muscle(document, 0);
    CHECK(document.scene().muscles.empty());
    while (document.undo()) {
    }
    CHECK(document.scene().bones.empty());
}

TEST_CASE("Removing a bone keeps the other bones' motion and attachments", "[document][actions]") {
    Document document = three_bones();
    actions::set_hinge(document, {Vec3::Zero(), Vec3::UnitX()}, 1.0, {10, 10, 10}, {2});
    CHECK(actions::bone_moves(document.scene(), 2));
    actions::remove_bone(document, 1);
    CHECK(document.scene().bones.size() == 2);
    CHECK(actions::bone_moves(document.scene(), 1));
    CHECK_FALSE(actions::bone_moves(document.scene(), 0));
    const auto& attachments = document.scene().muscles[0].attachments;
    REQUIRE(attachments.size() == 2);
    CHECK(attachments[0].bone == 0);
    CHECK(attachments[1].bone == 1);
    CHECK(attachments[1].vertices == std::vector<int>{2});
}

TEST_CASE("A hinge without a direction is refused", "[document][actions]") {
    Document document = three_bones();
    CHECK_THROWS_AS(actions::set_hinge(document, {Vec3::Zero(), Vec3::Zero()}, 1, {1, 1, 1}, {0}), Error);
    CHECK_THROWS_AS(actions::set_hinge(document, {Vec3::Zero(), Vec3::UnitX()}, 1, {-1, 1, 1}, {0}), Error);
    CHECK(steps(document) == 1);
    CHECK_FALSE(document.has_uncommitted_edits());
    actions::set_hinge(document, {Vec3::Zero(), Vec3::UnitX()}, 1, {5, 4, 3}, {0});
    CHECK(document.scene().timeline.last_frame == 12);
    CHECK(document.scene().timeline.angle_rad(5) == Approx(1));
}

TEST_CASE("A bone can be let move with the joint and held still again", "[document][actions]") {
    Document document = three_bones();
    CHECK_FALSE(actions::set_bone_moving(document, 0, true)); // no joint yet
    actions::set_hinge(document, {Vec3(1, 2, 3), Vec3(0, 0, 2)}, 2.5, {10, 20, 5}, {2});
    const std::size_t before = steps(document);
    CHECK_FALSE(actions::set_bone_moving(document, 2, true)); // it does already
    REQUIRE(actions::set_bone_moving(document, 0, true));
    CHECK(steps(document) == before + 1);
    const Timeline& timeline = document.scene().timeline;
    const Vec3 p(5, 1, 0);
    for (double frame = 0; frame <= 36; frame += 0.5) {
        INFO(frame);
        CHECK((timeline.bone_pose(0, frame).apply(p) - timeline.bone_pose(2, frame).apply(p)).norm() < 1e-9);
    }
    CHECK((timeline.bone_pose(0, 10).apply(p) - p).norm() > 1);
    REQUIRE(actions::set_bone_moving(document, 0, false));
    CHECK_FALSE(actions::bone_moves(document.scene(), 0));
    CHECK(actions::bone_moves(document.scene(), 2));
}

TEST_CASE("The unit of a mesh is guessed from its size", "[document][actions]") {
    CHECK(actions::guess_unit(*some_mesh()) == LengthUnit::metre);
    TriMesh large = *some_mesh();
    for (Vec3& p : large.positions)
        p *= 300;
    CHECK(actions::guess_unit(large) == LengthUnit::millimetre);
    for (Vec3& p : large.positions)
        p *= 300;
    CHECK_FALSE(actions::guess_unit(large));
    CHECK_FALSE(actions::guess_unit(TriMesh{}));
}

TEST_CASE("A fibre template is chosen in one step, and takes a file's template away", "[document][fibres]") {
    Document document = three_bones();
    CHECK(actions::choose_fibre_template(document, "fanned"));
    CHECK(steps(document) == 2);
    CHECK(document.scene().parameters.get_choice("fibres.method") == "kukacka");
    CHECK(document.scene().parameters.get_choice("fibres.template") == "fanned");
    REQUIRE(document.scene().fibre_templates != nullptr);
    CHECK_FALSE(actions::choose_fibre_template(document, "fanned"));
    CHECK_THROWS_AS(actions::choose_fibre_template(document, "spiral"), Error);
    CHECK(steps(document) == 2);

    auto own = std::make_shared<const FibreTemplate>(parallel_template());
    CHECK(actions::use_fibre_template(document, own, {"mine.json", {}}));
    CHECK(document.scene().muscles[0].fibre_template == own);
    CHECK(document.scene().muscles[0].fibre_template_source.path == "mine.json");
    CHECK_FALSE(actions::use_fibre_template(document, own, {"mine.json", {}}));
    CHECK(actions::choose_fibre_template(document, "fanned"));
    CHECK(document.scene().muscles[0].fibre_template == nullptr);
    document.undo();
    CHECK(document.scene().muscles[0].fibre_template == own);
}

TEST_CASE("A whole set of parameters is one step, and none when nothing changes", "[document][parameters]") {
    Document document = three_bones();
    ParamSet parameters = document.scene().parameters;
    CHECK_FALSE(actions::set_parameters(document, parameters, "Nothing"));
    parameters.set("solver.stiffness", 0.5);
    parameters.set("solver.bending", 0.6);
    CHECK(actions::set_parameters(document, parameters, "Preset Mine"));
    CHECK(steps(document) == 2);
    CHECK(document.history().undo_name() == "Preset Mine");
    document.undo();
    CHECK(document.scene().parameters == default_parameters());
}
