// Fibres that take up slack: active strain in both kernels, and how much the bones ask for.

#include "fascicle/geometry/primitives.hpp"
#include "fascicle/geometry/volume.hpp"
#include "fascicle/simulation/scene_solver.hpp"
#include "fascicle/simulation/simulation.hpp"
#include "fascicle/solver/active_strain.hpp"
#include "simulation/muscle_slack.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace fascicle;

namespace {

/// A bar of 80 x 10 x 10 mm along x between two blocks; the second one comes nearer by `way` in 60 frames.
Scene bar_scene(double way) {
    Scene scene;
    scene.bones.push_back(
        {"fixed", std::make_shared<TriMesh>(box_mesh(Vec3(-20, -8, -8), Vec3(-0.5, 8, 8), {4, 4, 4})), {}});
    scene.bones.push_back(
        {"sled", std::make_shared<TriMesh>(box_mesh(Vec3(80.5, -8, -8), Vec3(100, 8, 8), {4, 4, 4})), {}});
    Muscle bar;
    bar.name = "bar";
    bar.mesh = std::make_shared<TriMesh>(box_mesh(Vec3(0, -5, -5), Vec3(80, 5, 5), {32, 4, 4}));
    bar.attach_automatically = false;
    Attachment origin{AttachmentKind::origin, 0, {}}, insertion{AttachmentKind::insertion, 1, {}};
    for (int i = 0; i < bar.mesh->vertex_count(); ++i) {
        const double x = bar.mesh->positions[static_cast<std::size_t>(i)].x();
        if (x < 0.1)
            origin.vertices.push_back(i);
        else if (x > 79.9)
            insertion.vertices.push_back(i);
    }
    bar.attachments = {origin, insertion};
    scene.muscles.push_back(bar);
    scene.timeline = make_shift_timeline(Vec3(-way, 0, 0), {60, 0, 60}, 2, 1);
    return scene;
}

/// How far the bar's middle has left its axis, and its width there over that at rest.
std::pair<double, double> sag_and_width(const Scene& scene, const Frame& frame) {
    const Points &rest = scene.muscles[0].mesh->positions, &now = *frame.muscle_positions[0];
    Vec3 middle = Vec3::Zero();
    double count = 0, low = 1e9, high = -1e9;
    for (std::size_t i = 0; i < rest.size(); ++i)
        if (std::abs(rest[i].x() - 40) < 1.3) {
            middle += now[i];
            ++count;
            low = std::min(low, now[i].y());
            high = std::max(high, now[i].y());
        }
    middle /= count;
    return {std::hypot(middle.y(), middle.z()), (high - low) / 10.0};
}

} // namespace

TEST_CASE("active strain: along the fibres s, across s^(-1/2), and the volume stays", "[solver][tone]") {
    CHECK(active_edge_scale(1.0, 0.8) == Approx(0.8));
    CHECK(active_edge_scale(0.0, 0.8) == Approx(1.0 / std::sqrt(0.8)));
    for (const double c : {0.0, 0.3, 1.0})
        CHECK(active_edge_scale(c, 1.0) == Approx(1.0));
    // |F e| of an edge at 30 degrees, component by component.
    const double s = 0.7, angle = std::numbers::pi / 6;
    const double along = s * std::cos(angle), across = std::sin(angle) / std::sqrt(s);
    CHECK(active_edge_scale(std::pow(std::cos(angle), 2), s) == Approx(std::hypot(along, across)));
    CHECK(s * std::pow(1.0 / std::sqrt(s), 2) == Approx(1.0)); // det F
}

TEST_CASE("blended poses: halfway of a hinge is half the turn, and a share of one is that pose",
          "[simulation][tone]") {
    const Vec3 centre(3, -2, 5);
    const std::vector<Pose> poses{Pose{}, rotation_about(centre, Vec3(1, 2, -1), 1.2)};
    const Pose half = blended_pose(poses, std::vector<double>{0.5, 0.5});
    const Pose expected = rotation_about(centre, Vec3(1, 2, -1), 0.6);
    CHECK((half.rotation - expected.rotation).norm() < 1e-12);
    CHECK((half.translation - expected.translation).norm() < 1e-11);
    CHECK((blended_pose(poses, std::vector<double>{0.0, 1.0}).rotation - poses[1].rotation).norm() < 1e-12);
    CHECK((blended_pose(poses, std::vector<double>{1.0, 0.0}).translation).norm() < 1e-12);
    // Both turned alike: no matter which shares.
    const std::vector<Pose> same{poses[1], poses[1]};
    CHECK((blended_pose(same, std::vector<double>{0.3, 0.7}).translation - poses[1].translation).norm() <
          1e-11);
}

TEST_CASE("slack: the middle line shortens with the bones, and turns about a hinge at its own radius",
          "[simulation][tone]") {
    Scene scene = bar_scene(16);
    const PreparedScene prepared = prepare_scene(scene, 1, {});
    const MuscleSlack slack(scene, prepared.muscles[0]);
    CHECK(slack.length(bone_poses(scene, 0)) == Approx(1.0));
    CHECK(slack.length(bone_poses(scene, 60)) == Approx(0.8).epsilon(1e-3));
    // Turned as a whole it keeps its length.
    const Pose turn = rotation_about(Vec3(1, 2, 3), Vec3(1, 1, 0), 0.9);
    CHECK(slack.length(std::vector<Pose>{turn, turn}) == Approx(1.0).epsilon(1e-9));
    // A hinge 30 mm beside the line: the line shortens by about the angle times 30 mm.
    const Pose hinge = rotation_about(Vec3(40, 30, 0), Vec3(0, 0, 1), 0.3);
    CHECK(80.0 * (slack.length(std::vector<Pose>{Pose{}, hinge}) - 1.0) == Approx(0.3 * 30.0).epsilon(0.08));

    scene.muscles[0].attachments.pop_back();
    const PreparedScene loose = prepare_scene(scene, 1, {});
    CHECK(MuscleSlack(scene, loose.muscles[0]).length(bone_poses(scene, 60)) == 1.0);
}

TEST_CASE("a bar pressed by a fifth shortens and thickens with tone, and bends away without",
          "[simulation][tone]") {
    Scene scene = bar_scene(16);
    scene.parameters.set_text("solver.kernel", GENERATE(std::string("fast"), std::string("reference")));
    const auto run = [&](double tone) {
        scene.parameters.set("solver.tone", tone);
        auto recording = std::make_shared<Recording>(std::make_shared<const Scene>(scene));
        run_simulation(*recording, {1}, {});
        REQUIRE(recording->state() == RunState::finished);
        const Points& x = *recording->frame(120)->muscle_positions[0];
        CHECK(signed_volume(x, scene.muscles[0].mesh->triangles) == Approx(8000.0).epsilon(2e-3));
        return sag_and_width(scene, *recording->frame(120));
    };
    const auto [sag, width] = run(1.0);
    CHECK(sag < 1.0);
    CHECK(width == Approx(1.0 / std::sqrt(0.8)).epsilon(0.03));
}

TEST_CASE("without tone, or while a muscle is stretched, nothing changes", "[simulation][tone]") {
    Scene scene = bar_scene(-8);
    const auto last = [&](double tone) {
        scene.parameters.set("solver.tone", tone);
        auto recording = std::make_shared<Recording>(std::make_shared<const Scene>(scene));
        run_simulation(*recording, {1}, {});
        return *recording->frame(60)->muscle_positions[0];
    };
    CHECK(last(0.0) == last(1.0));
}
