#include "fascicle/metrics/bone_distance.hpp"
#include "fascicle/metrics/muscle_measure.hpp"
#include "fascicle/metrics/worst_vertex.hpp"
#include "geometry/surface_oracles.hpp"
#include "metrics/measured_scene.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;

namespace {

TriMesh moved(TriMesh mesh, const Vec3& shift) {
    for (Vec3& p : mesh.positions)
        p += shift;
    return mesh;
}

/// A ball of radius 5 whose lowest point is 1 over the bone "bone0" (z <= 0) and 3 from "bone1" (x >= 8).
std::shared_ptr<Scene> ball_over_floor() {
    return test::scene_of(test::sphere(5, 3, Vec3(0, 0, 6)),
                          {moved(test::box(100, 100, 20), Vec3(-50, -50, -20)),
                           moved(test::box(20, 100, 100), Vec3(8, -50, 0.5))});
}

} // namespace

TEST_CASE("Distances to bones are those of the definition, in any order", "[metrics][bone_distance]") {
    TriMesh cup = test::sphere(6, 2, Vec3(9, 0, 0)); // open: without its lid
    std::erase_if(cup.triangles,
                  [&](const Tri& t) { return cup.positions[static_cast<std::size_t>(t[0])].z() > 4.0; });
    const TriMesh muscle = test::sphere(3, 2);
    const auto scene = test::scene_of(muscle, {test::torus(12, 3), cup, test::sphere(4, 2, Vec3(0, -8, 0))});
    const double reach = 2.0;
    BoneDistanceMeasure measure(bone_solids(*scene), 1.0, reach, GENERATE(1, 2));
    test::Random random(3);
    int inside = 0, outside = 0;
    for (int i = 0; i < 30; ++i) {
        const Vec3 way = random.in_box(Vec3::Constant(-12), Vec3::Constant(12));
        const std::vector<Pose> poses{rotation_about(Vec3::Zero(), Vec3(0, 1, 0), 0.1 * i), Pose{},
                                      rotation_about(Vec3(1, 2, 3), Vec3(1, 1, 0), -0.2 * i)};
        const Points points = moved(muscle, way).positions;
        const auto found = measure.measure(points, poses);
        for (std::size_t v = 0; v < points.size(); v += 7) {
            double expected = reach;
            for (std::size_t b = 0; b < poses.size(); ++b)
                expected = std::min(expected, test::signed_distance(*scene->bones[b].mesh,
                                                                    poses[b].apply_inverse(points[v])));
            CHECK(found[v].mm == Approx(std::max(-reach, expected)).margin(1e-9));
            CHECK((found[v].bone < 0) == (expected >= reach));
            inside += expected < 0;
            outside += expected > 0;
        }
    }
    CHECK(inside > 20);
    CHECK(outside > 20);
}

TEST_CASE("Distances are told in millimetres, with the bone", "[metrics][bone_distance]") {
    BoneDistanceMeasure measure({std::make_shared<const SolidQuery>(test::box(0.01, 0.01, 0.01)),
                                 std::make_shared<const SolidQuery>()},
                                1000.0, 4.0);
    const Points points{
        {0.005, 0.005, 0.013}, {0.005, 0.005, 0.009}, {0.005, 0.005, 0.02}, Vec3::Constant(std::nan(""))};
    const auto found = measure.measure(points, {Pose{}, Pose{}});
    CHECK(found[0].mm == Approx(3.0));
    CHECK(found[0].bone == 0);
    CHECK(found[1].mm == Approx(-1.0));
    CHECK(found[2].mm == 4.0);
    CHECK(found[2].bone == -1);
    CHECK(found[3].mm == 4.0);
}

TEST_CASE("The worst vertex is the deepest one, with its bone", "[metrics][worst_vertex]") {
    const auto scene = ball_over_floor();
    const Frame rest = test::rest_frame(*scene);
    const auto find = [&](const Vec3& shift, const std::vector<std::vector<Attachment>>& attachments = {}) {
        return worst_vertex(*scene, rest,
                            test::frame_of(*scene, moved(*scene->muscles[0].mesh, shift).positions),
                            attachments, bone_solids(*scene));
    };
    const auto floor = find(Vec3(0, 0, -3));
    REQUIRE(floor);
    CHECK(floor->penetrating);
    CHECK(floor->depth_mm == Approx(2.0));
    CHECK(floor->bone == 0);
    CHECK(floor->muscle == 0);
    CHECK((floor->point - Vec3(0, 0, -2)).norm() < 1e-9);
    CHECK(
        (scene->muscles[0].mesh->positions[static_cast<std::size_t>(floor->vertex)] - Vec3(0, 0, 1)).norm() <
        1e-9);
    const auto wall = find(Vec3(4.5, 0, -1.5)); // 1.5 into the wall, 0.5 into the floor
    REQUIRE(wall);
    CHECK(wall->bone == 1);
    CHECK(wall->depth_mm == Approx(1.5));

    const auto near = find(Vec3::Zero());
    REQUIRE(near);
    CHECK_FALSE(near->penetrating);
    CHECK(near->depth_mm == Approx(-1.0));
    CHECK(near->bone == 0);
    // The same vertex attached: the next one above it.
    const auto next = find(Vec3::Zero(), {{{AttachmentKind::origin, 0, {near->vertex}}}});
    REQUIRE(next);
    CHECK(next->vertex != near->vertex);
    CHECK(next->depth_mm < near->depth_mm);
    // Within the tolerance nothing penetrates.
    const auto touching = find(Vec3(0, 0, -1.05));
    REQUIRE(touching);
    CHECK_FALSE(touching->penetrating);
    CHECK(touching->depth_mm == Approx(0.05));
}

TEST_CASE("Without bones, and inside since rest, there is no worst vertex", "[metrics][worst_vertex]") {
    const auto alone = test::scene_of(test::box());
    const Frame rest = test::rest_frame(*alone);
    CHECK_FALSE(worst_vertex(*alone, rest, rest, {}, {}));
    const auto within =
        test::scene_of(test::sphere(1, 1), {moved(test::box(20, 20, 20), Vec3::Constant(-10))});
    const Frame inside = test::rest_frame(*within);
    CHECK_FALSE(worst_vertex(*within, inside, inside, {}, bone_solids(*within)));
}
