#include "fascicle/metrics/metric_table.hpp"
#include "fascicle/metrics/muscle_overlap.hpp"
#include "geometry/surface_oracles.hpp"
#include "metrics/measured_scene.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>
#include <limits>

using namespace fascicle;

namespace {

std::shared_ptr<Scene> muscles_of(const std::vector<TriMesh>& meshes,
                                  LengthUnit unit = LengthUnit::millimetre) {
    auto scene = test::scene_of(meshes.at(0), {}, unit);
    for (std::size_t i = 1; i < meshes.size(); ++i) {
        scene->muscles.push_back(scene->muscles[0]);
        scene->muscles[i].name = "muscle" + std::to_string(i);
        scene->muscles[i].mesh = test::shared(meshes[i]);
    }
    return scene;
}

/// Muscle i shifted by shifts[i].
Frame shifted(const Scene& scene, const std::vector<Vec3>& shifts) {
    Frame frame;
    for (std::size_t m = 0; m < scene.muscles.size(); ++m)
        frame.muscle_positions.push_back(std::make_shared<const Points>(test::mapped(
            scene.muscles[m].mesh->positions, [&](const Vec3& p) { return Vec3(p + shifts[m]); })));
    return frame;
}

/// By definition, without trees.
double brute_force(const Scene& scene, std::size_t m, const Frame& rest, const Frame& frame) {
    double largest = 0;
    const auto depth = [&](const Frame& f, std::size_t other, std::size_t v) {
        const TriMesh mesh{*f.muscle_positions[other], scene.muscles[other].mesh->triangles};
        return std::max(0.0, -test::signed_distance(mesh, (*f.muscle_positions[m])[v]));
    };
    for (std::size_t other = 0; other < scene.muscles.size(); ++other)
        for (std::size_t v = 0; other != m && v < rest.muscle_positions[m]->size(); ++v)
            largest = std::max(largest, depth(frame, other, v) - depth(rest, other, v));
    return largest;
}

} // namespace

TEST_CASE("Two balls pushed into each other by a known depth", "[metrics][overlap]") {
    // A pole of each is the deepest vertex; facets are a little nearer than the sphere.
    const double unit = GENERATE(1.0, 0.001);
    const auto scene =
        muscles_of({test::sphere(10 * unit, 4), test::sphere(10 * unit, 4, Vec3(21, 0, 0) * unit)},
                   unit == 1.0 ? LengthUnit::millimetre : LengthUnit::metre);
    const Vec3 along = Vec3(-unit, 0, 0), none = Vec3::Zero();
    SECTION("apart at rest") {
        MuscleOverlapMeasure measure(scene, shifted(*scene, {none, none}));
        CHECK(measure.measure(shifted(*scene, {none, none})) == std::vector<double>{0, 0});
        for (const double depth : {0.5, 1.0, 2.0}) {
            const auto values = measure.measure(shifted(*scene, {none, (1 + depth) * along}));
            CHECK(values[0] == Approx(depth).margin(0.02));
            CHECK(values[1] == Approx(depth).margin(0.02));
        }
        CHECK(measure.measure(shifted(*scene, {none, 0.9 * along})) == std::vector<double>{0, 0});
    }
    SECTION("what was inside at rest counts beyond its depth there") {
        MuscleOverlapMeasure measure(scene, shifted(*scene, {none, 1.4 * along}));
        CHECK(measure.measure(shifted(*scene, {none, 1.4 * along})) == std::vector<double>{0, 0});
        CHECK(measure.measure(shifted(*scene, {none, 1.2 * along})) == std::vector<double>{0, 0});
        CHECK(measure.measure(shifted(*scene, {none, 2.4 * along}))[1] == Approx(1.0).margin(0.02));
    }
}

TEST_CASE("A ball in a box: only what is inside counts, exactly", "[metrics][overlap]") {
    const auto scene = muscles_of({test::box(40, 40, 40), test::sphere(5, 3, Vec3(20, 20, 46))});
    MetricsEngine engine(scene, shifted(*scene, {Vec3::Zero(), Vec3::Zero()}));
    const auto row = static_cast<std::size_t>(metric_index("muscle_overlap_mm"));
    const auto values = engine.measure(shifted(*scene, {Vec3::Zero(), Vec3(0, 0, -3.5)}));
    CHECK(values[0][row] == 0.0); // no corner of the box is in the ball
    CHECK(values[1][row] == Approx(2.5));
    // One muscle alone has nothing to be in.
    const auto alone = test::scene_of(test::box());
    MetricsEngine single(alone, test::rest_frame(*alone));
    CHECK(single.measure(test::rest_frame(*alone))[0][row] == 0.0);
}

TEST_CASE("Overlaps are those of the definition, in any order and for any number of threads",
          "[metrics][overlap]") {
    const auto scene =
        muscles_of({test::torus(12, 4), test::sphere(4, 2, Vec3(12, 0, 1)), test::box(6, 6, 6)});
    const Frame rest = shifted(*scene, {Vec3::Zero(), Vec3::Zero(), Vec3(-14, -3, 3)});
    MuscleOverlapMeasure one(scene, rest, 1), two(scene, rest, 2);
    test::Random random(5);
    int hits = 0;
    for (int i = 0; i < 25; ++i) {
        std::vector<Vec3> shifts;
        for (std::size_t m = 0; m < 3; ++m)
            shifts.push_back(random.in_box(Vec3::Constant(-6), Vec3::Constant(6)));
        const Frame frame = shifted(*scene, shifts);
        const std::vector<double> values = one.measure(frame);
        CHECK(two.measure(frame) == values);
        for (std::size_t m = 0; m < 3; ++m) {
            CHECK(values[m] == Approx(brute_force(*scene, m, rest, frame)).margin(1e-9));
            hits += values[m] > 0;
        }
    }
    CHECK(hits > 20);
}

TEST_CASE("Vertices without triangles and those that are not finite are passed over", "[metrics][overlap]") {
    TriMesh ball = test::sphere(5, 2, Vec3(20, 20, 50));
    ball.positions.push_back(Vec3(20, 20, 20)); // in the middle of the box, of no triangle
    const auto scene = muscles_of({test::box(40, 40, 40), ball});
    const Frame rest = shifted(*scene, {Vec3::Zero(), Vec3::Zero()});
    MuscleOverlapMeasure measure(scene, rest);
    CHECK(measure.measure(rest) == std::vector<double>{0, 0});
    Frame broken = shifted(*scene, {Vec3::Zero(), Vec3(0, 0, -8)});
    Points points = *broken.muscle_positions[1];
    points[5] = Vec3::Constant(std::numeric_limits<double>::quiet_NaN()); // the lowest
    broken.muscle_positions[1] = std::make_shared<const Points>(points);
    const auto values = measure.measure(broken);
    CHECK(values[0] == 0.0);
    CHECK(values[1] > 1.0);
    CHECK(values[1] < 3.0);
}
