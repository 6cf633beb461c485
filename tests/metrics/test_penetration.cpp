#include "fascicle/metrics/muscle_measure.hpp"
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

/// By definition, without any tree or cache.
Penetration brute_force(const Scene& scene, const Frame& rest, const Frame& frame, double mm) {
    Penetration result;
    for (std::size_t v = 0; v < rest.muscle_positions[0]->size(); ++v) {
        double depth = 0;
        for (std::size_t b = 0; b < scene.bones.size(); ++b) {
            const auto distance = [&](const Frame& f) {
                return test::signed_distance(*scene.bones[b].mesh,
                                             f.bone_poses[b].apply_inverse((*f.muscle_positions[0])[v]));
            };
            if (distance(rest) >= 0.0)
                depth = std::max(depth, -mm * distance(frame));
        }
        result.count += depth > 0.1;
        result.max_mm = std::max(result.max_mm, depth);
    }
    return result;
}

} // namespace

TEST_CASE("a ball pushed into a box", "[metrics][penetration]") {
    // The box is z <= 0; the ball's lowest point is 1 mm above at rest.
    const TriMesh ball = moved(test::sphere(5, 3), Vec3(0, 0, 6));
    const auto scene = test::scene_of(ball, {moved(test::box(100, 100, 20), Vec3(-50, -50, -20))});
    const Frame rest = test::rest_frame(*scene);
    MuscleMeasure m(*scene, 0, rest, bone_solids(*scene), std::nullopt);
    CHECK(m.penetration().count == 0);
    CHECK(m.penetration().max_mm == 0.0);
    CHECK(std::isnan(m.attachment_drift_mm()));
    m.measure(test::frame_of(*scene, moved(ball, Vec3(0, 0, -3)).positions));
    int expected = 0;
    for (const Vec3& p : ball.positions)
        expected += p.z() - 3.0 < -0.1;
    CHECK(expected > 3);
    CHECK(m.penetration().count == expected);
    CHECK(m.penetration().max_mm == Approx(2.0));
    for (std::size_t v = 0; v < ball.positions.size(); ++v)
        CHECK(m.depth_mm_at_vertices()[v] == Approx(std::max(0.0, 3.0 - ball.positions[v].z())).margin(1e-9));
    // Within the tolerance nothing is counted, but the depth is told.
    m.measure(test::frame_of(*scene, moved(ball, Vec3(0, 0, -1.08)).positions));
    CHECK(m.penetration().count == 0);
    CHECK(m.penetration().max_mm == Approx(0.08));
}

TEST_CASE("vertices inside at rest never count for that bone, but do for another", "[metrics][penetration]") {
    const TriMesh ball = test::sphere(5, 3);
    const TriMesh below = moved(test::box(100, 100, 20), Vec3(-50, -50, -24)); // up to z = -4
    const TriMesh beside = moved(test::box(20, 100, 100), Vec3(7, -50, -50));  // from x = 7
    const auto scene = test::scene_of(ball, {below, beside});
    const Frame rest = test::rest_frame(*scene);
    MuscleMeasure m(*scene, 0, rest, bone_solids(*scene), std::nullopt);
    int inside_at_rest = 0, expected = 0, into_beside = 0;
    for (const Vec3& p : ball.positions) {
        inside_at_rest += p.z() < -4;
        expected += p.z() >= -4 && p.z() - 1.0 < -4.1;
        into_beside += p.x() + 10.0 > 7.1;
    }
    REQUIRE(inside_at_rest > 0);
    m.measure(test::frame_of(*scene, moved(ball, Vec3(0, 0, -1)).positions));
    CHECK(m.penetration().count == expected);
    m.measure(test::frame_of(*scene, moved(ball, Vec3(10, 0, 0)).positions));
    CHECK(m.penetration().count == into_beside);
}

TEST_CASE("what is kept between frames never changes the answer", "[metrics][penetration]") {
    // An open bone among them: a cup without its lid.
    TriMesh cup = test::sphere(6, 2, Vec3(9, 0, 0));
    std::erase_if(cup.triangles,
                  [&](const Tri& t) { return cup.positions[static_cast<std::size_t>(t[0])].z() > 4.0; });
    const double unit = GENERATE(1.0, 0.001);
    auto scaled = [&](TriMesh mesh) {
        for (Vec3& p : mesh.positions)
            p *= unit;
        return mesh;
    };
    const TriMesh muscle = scaled(test::sphere(3, 2));
    const auto scene = test::scene_of(
        muscle, {scaled(test::torus(12, 3)), scaled(cup), scaled(test::sphere(4, 2, Vec3(0, -8, 0)))},
        unit == 1.0 ? LengthUnit::millimetre : LengthUnit::metre);
    const Frame rest = test::rest_frame(*scene);
    const int threads = GENERATE(1, 2);
    MuscleMeasure m(*scene, 0, rest, bone_solids(*scene), std::nullopt, threads);
    // A path through the bones, sampled in random order, in small and in large steps.
    std::vector<Frame> frames;
    for (int i = 0; i < 40; ++i) {
        const double t = 0.2 * i;
        const Vec3 way = unit * Vec3(12 * std::sin(t), 12 * std::cos(0.7 * t) - 12, 5 * std::sin(1.3 * t));
        frames.push_back(test::frame_of(*scene, moved(muscle, way).positions,
                                        {rotation_about(Vec3::Zero(), Vec3(0, 1, 0), 0.1 * t), Pose{},
                                         rotation_about(unit * Vec3(1, 2, 3), Vec3(1, 1, 0), -0.2 * t)}));
    }
    std::vector<Penetration> expected;
    int hits = 0;
    for (const Frame& frame : frames) {
        expected.push_back(brute_force(*scene, rest, frame, 1.0 / unit));
        hits += expected.back().count > 0;
    }
    CHECK(hits > 5);
    test::Random random(77);
    for (int i = 0; i < 120; ++i) {
        const std::size_t k = i < 40 ? static_cast<std::size_t>(i) : random.index(frames.size());
        m.measure(frames[k]);
        CHECK(m.penetration().count == expected[k].count);
        CHECK(m.penetration().max_mm == Approx(expected[k].max_mm).margin(1e-9));
    }
}
