#include "fascicle/metrics/muscle_measure.hpp"
#include "fascicle/metrics/surface_samples.hpp"
#include "metrics/measured_scene.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;

namespace {

/// A muscle [0, 10]^3, two triangles a side, and a bone 1 x 1 x 4 with its lower end at z = 11, centred over a point.
std::shared_ptr<Scene> poked_box(const Vec3& under, double unit = 1.0) {
    TriMesh muscle = test::box(10, 10, 10), bone = test::box(1, 1, 4);
    for (Vec3& p : bone.positions)
        p += Vec3(under.x() - 0.5, under.y() - 0.5, 11);
    for (TriMesh* mesh : {&muscle, &bone})
        for (Vec3& p : mesh->positions)
            p *= unit;
    return test::scene_of(muscle, {bone}, unit == 1.0 ? LengthUnit::millimetre : LengthUnit::metre);
}

Frame bone_lowered(const Scene& scene, double by) {
    return test::frame_of(scene, scene.muscles[0].mesh->positions, {Pose{Mat3::Identity(), Vec3(0, 0, -by)}});
}

// Two triangles make the side z = 10; their centroids and the middle of their common edge.
const Vec3 centroid(20.0 / 3, 10.0 / 3, 10), middle(5, 5, 10);

} // namespace

TEST_CASE("Centroids and midpoints of a box", "[metrics][penetration]") {
    const TriMesh box = test::box(10, 10, 10);
    const MeshTopology topology(box.vertex_count(), box.triangles);
    Points centroids, midpoints;
    face_centroids(box.positions, box.triangles, centroids);
    edge_midpoints(box.positions, topology.edges(), midpoints);
    CHECK(centroids.size() == 12);
    CHECK(midpoints.size() == 18);
    const auto holds = [](const Points& points, const Vec3& p) {
        return std::any_of(points.begin(), points.end(),
                           [&](const Vec3& q) { return (p - q).norm() < 1e-12; });
    };
    CHECK(holds(centroids, centroid));
    CHECK(holds(midpoints, middle));
    CHECK(holds(midpoints, Vec3(5, 0, 0)));
}

TEST_CASE("A bone that comes through a triangle or an edge between vertices is seen",
          "[metrics][penetration]") {
    const double unit = GENERATE(1.0, 0.001);
    SECTION("through a centroid") {
        const auto scene = poked_box(centroid, unit);
        MuscleMeasure m(*scene, 0, test::rest_frame(*scene), bone_solids(*scene), std::nullopt);
        CHECK(m.centroid_penetration().max_mm == 0.0);
        m.measure(bone_lowered(*scene, 1.3 * unit));
        CHECK(m.penetration().count == 0);
        CHECK(m.penetration().max_mm == 0.0);
        CHECK(m.midpoint_penetration().max_mm == 0.0);
        CHECK(m.centroid_penetration().count == 1);
        CHECK(m.centroid_penetration().max_mm == Approx(0.3));
        m.measure(bone_lowered(*scene, 1.05 * unit)); // within the tolerance
        CHECK(m.centroid_penetration().count == 0);
        CHECK(m.centroid_penetration().max_mm == Approx(0.05));
    }
    SECTION("through the middle of an edge") {
        const auto scene = poked_box(middle, unit);
        MuscleMeasure m(*scene, 0, test::rest_frame(*scene), bone_solids(*scene), std::nullopt);
        m.measure(bone_lowered(*scene, 1.4 * unit));
        CHECK(m.penetration().count == 0);
        CHECK(m.centroid_penetration().max_mm == 0.0);
        CHECK(m.midpoint_penetration().count == 1);
        CHECK(m.midpoint_penetration().max_mm == Approx(0.4));
    }
}

TEST_CASE("Centroids and midpoints inside at rest never count", "[metrics][penetration]") {
    for (const Vec3& under : {centroid, middle}) {
        const auto scene = poked_box(under);
        MuscleMeasure m(*scene, 0, bone_lowered(*scene, 1.2), bone_solids(*scene), std::nullopt);
        m.measure(bone_lowered(*scene, 1.4));
        CHECK(m.centroid_penetration().max_mm == 0.0);
        CHECK(m.midpoint_penetration().max_mm == 0.0);
    }
}
