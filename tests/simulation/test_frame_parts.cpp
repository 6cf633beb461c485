// Frames in which bones move far: solved in parts, whatever is asked.

#include "fascicle/geometry/volume.hpp"
#include "fascicle/scene/embedded_scenes.hpp"
#include "fascicle/simulation/scene_solver.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

using namespace fascicle;

TEST_CASE("a frame is one part until a bone turns by 0.15 rad or moves by a tenth of the muscles' size",
          "[simulation][parts]") {
    BoundingBox box;
    box.add(Vec3(-30, -40, 0));
    box.add(Vec3(30, 40, 0)); // diagonal 100
    const std::vector<Pose> rest{Pose{}, Pose{}};
    const auto turned = [](double angle) {
        return std::vector<Pose>{Pose{}, rotation_about(Vec3::Zero(), Vec3::UnitX(), angle)};
    };
    const auto shifted = [](const Vec3& way) {
        return std::vector<Pose>{Pose{}, Pose{Eigen::Matrix3d::Identity(), way}};
    };
    CHECK(frame_parts(rest, rest, box) == 1);
    CHECK(frame_parts(rest, turned(0.1), box) == 1);
    CHECK(frame_parts(rest, turned(0.15), box) == 1);
    CHECK(frame_parts(rest, turned(-0.16), box) == 2);
    CHECK(frame_parts(rest, turned(2.0), box) == 14);
    CHECK(frame_parts(turned(2.0), rest, box) == 14);
    CHECK(frame_parts(rest, shifted(Vec3(0, 0, 9.9)), box) == 1);
    CHECK(frame_parts(rest, shifted(Vec3(0, 0, 25)), box) == 3);
    CHECK(frame_parts(rest, shifted(Vec3(1e30, 0, 0)), box) == 1000);
    CHECK(frame_parts(rest, shifted(Vec3(5, 0, 0)), BoundingBox{}) == 1); // no muscle, nothing to measure by
}

TEST_CASE("120 degrees in a single frame: the muscles stay whole and come to rest at a plausible length",
          "[simulation][parts][slow]") {
    Scene scene = make_embedded_scene("hip");
    scene.parameters.set("solver.iterations", 3);
    const PreparedScene prepared = prepare_scene(scene, 2, {});
    SceneSolver solver(scene, prepared, 2);
    const auto rest = bone_poses(scene, 0);
    auto bent = rest;
    bent[static_cast<std::size_t>(scene.bone_index("femur"))] =
        rotation_about(scene.timeline.hinge->centre, Vec3::UnitX(), -2.0 * std::acos(-1.0) / 3.0);
    solver.advance(rest, bent);
    for (std::size_t m = 0; m < solver.muscle_count(); ++m) {
        const TriMesh& mesh = *scene.muscles[m].mesh;
        const Points& x = solver.muscle(m).positions();
        INFO(scene.muscles[m].name);
        CHECK(std::all_of(x.begin(), x.end(), [](const Vec3& p) { return p.allFinite(); }));
        CHECK(signed_volume(x, mesh.triangles) ==
              Approx(signed_volume(prepared.muscles[m].problem.surface->positions, mesh.triangles))
                  .epsilon(0.01));
    }
    const std::size_t before = static_cast<std::size_t>(solver.report().contacts);
    solver.advance(bent, rest);
    CHECK(static_cast<std::size_t>(solver.report().contacts) >= before);
}
