// Metrics of the shape alone, against closed forms.

#include "fascicle/geometry/volume.hpp"
#include "fascicle/metrics/muscle_measure.hpp"
#include "geometry/surface_oracles.hpp"
#include "metrics/measured_scene.hpp"
#include "support/shapes.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <numbers>

using namespace fascicle;

namespace {

MuscleMeasure measure_of(const Scene& scene) {
    return {scene, 0, test::rest_frame(scene), bone_solids(scene), scene.muscles[0].attachments};
}

} // namespace

TEST_CASE("uniform scaling", "[metrics][muscle_measure]") {
    const auto scene = test::scene_of(test::torus(30, 10));
    const Points& rest = scene->muscles[0].mesh->positions;
    MuscleMeasure m = measure_of(*scene);
    const double s = GENERATE(0.5, 1.0, 1.7);
    m.measure(test::frame_of(*scene, test::mapped(rest, [&](const Vec3& p) { return Vec3(s * p); })));
    CHECK(m.volume_ratio() == Approx(s * s * s));
    CHECK(m.volume_cm3() ==
          Approx(signed_volume(rest, scene->muscles[0].mesh->triangles) * s * s * s / 1000.0));
    CHECK(m.area_cm2() == Approx(surface_area(rest, scene->muscles[0].mesh->triangles) * s * s / 100.0));
    const EdgeExtension& e = m.edges();
    for (const double x : {e.mean, e.p1, e.p10, e.p25, e.p50, e.p75, e.p90, e.p99, e.max})
        CHECK(x == Approx(s));
    CHECK(m.dihedrals().mean_rad < 1e-10);
    CHECK(m.dihedrals().p90_rad < 1e-10);
    CHECK(m.dihedrals().unsigned_mean_deg < 1e-9);
    CHECK(m.dihedrals().share_above_90_deg == 0.0);
    for (const double x : m.edge_extension_at_vertices())
        CHECK(x == Approx(s));
    CHECK(m.rest_distance().max == Approx(40.0 * std::abs(s - 1.0)).margin(1e-12));
}

TEST_CASE("a rigid motion changes nothing but the place", "[metrics][muscle_measure]") {
    const auto scene = test::scene_of(test::torus(30, 10));
    const Points& rest = scene->muscles[0].mesh->positions;
    MuscleMeasure m = measure_of(*scene);
    const Pose pose = rotation_about(Vec3(5, -2, 9), Vec3(1, 2, 3), 1.1);
    m.measure(test::frame_of(*scene, test::mapped(rest, [&](const Vec3& p) { return pose.apply(p); })));
    CHECK(m.volume_ratio() == Approx(1.0));
    CHECK(m.edges().mean == Approx(1.0));
    CHECK(m.edges().max == Approx(1.0));
    CHECK(m.dihedrals().mean_rad < 1e-9);
    double sum = 0, squares = 0, largest = 0;
    for (const Vec3& p : rest) {
        const double d = (pose.apply(p) - p).norm();
        sum += d;
        squares += d * d;
        largest = std::max(largest, d);
    }
    const auto n = static_cast<double>(rest.size());
    CHECK(m.rest_distance().mean == Approx(sum / n));
    CHECK(m.rest_distance().rms == Approx(std::sqrt(squares / n)));
    CHECK(m.rest_distance().max == Approx(largest));
    CHECK(m.rest_distance().hausdorff > 1.0);
    CHECK(m.rest_distance().hausdorff <= largest);
}

TEST_CASE("edge extension of a stretched box, edge by edge", "[metrics][edge_extension]") {
    const auto scene = test::scene_of(test::box(1, 1, 1));
    MuscleMeasure m = measure_of(*scene);
    m.measure(test::frame_of(*scene, test::mapped(scene->muscles[0].mesh->positions, [](const Vec3& p) {
        return Vec3(2 * p.x(), p.y(), p.z());
    })));
    // 12 edges: 4 along x (2), 8 across (1); 6 diagonals: 2 in x = const (1), 4 others (sqrt(5/2)).
    const double slanted = std::sqrt(2.5);
    CHECK(m.edges().mean == Approx((4 * 2.0 + 8 + 2 + 4 * slanted) / 18.0));
    CHECK(m.edges().p50 == Approx(1.0));
    CHECK(m.edges().p75 ==
          Approx(slanted)); // position 12.75 of 0 .. 17: ten times 1, four slanted, four times 2
    CHECK(m.edges().max == Approx(2.0));
    CHECK(m.volume_ratio() == Approx(2.0));
}

TEST_CASE("dihedral change of a folded sheet", "[metrics][dihedral_change]") {
    // Two triangles over the edge x = 0; the right one turns up by 120 degrees, then down.
    const TriMesh mesh{{Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(1, 0, 0), Vec3(-1, 0, 0)}, {{0, 2, 1}, {0, 1, 3}}};
    const MeshTopology topology(4, mesh.triangles);
    DihedralChangeMeasure measure(topology.dihedrals(), mesh.positions);
    const double fold = 2.0 * std::numbers::pi / 3.0;
    const auto folded = [&](double angle) {
        Points points = mesh.positions;
        points[2] = Vec3(std::cos(angle), 0, std::sin(angle));
        return points;
    };
    for (const double angle : {fold, -fold}) {
        const DihedralChange change = measure.measure(folded(angle));
        CHECK(change.mean_rad == Approx(fold));
        CHECK(change.p10_rad == Approx(fold));
        CHECK(change.p90_rad == Approx(fold));
        CHECK(change.unsigned_mean_deg == Approx(120.0));
        CHECK(change.share_above_90_deg == 1.0);
    }
    // From folded up to folded down the unsigned form sees nothing, the signed one wraps: 2 pi - 240 degrees.
    DihedralChangeMeasure from_folded(topology.dihedrals(), folded(fold));
    const DihedralChange change = from_folded.measure(folded(-fold));
    CHECK(change.mean_rad == Approx(fold));
    CHECK(change.unsigned_mean_deg == Approx(0.0).margin(1e-9));
    CHECK(std::isnan(DihedralChangeMeasure({}, mesh.positions).measure(mesh.positions).mean_rad));
}

TEST_CASE("Hausdorff distance against brute force", "[metrics][rest_distance]") {
    const TriMesh mesh = test::torus(3, 1);
    test::Random random(31);
    RestDistanceMeasure measure(mesh.triangles, mesh.positions);
    for (int i = 0; i < 12; ++i) {
        TriMesh now = mesh;
        const Vec3 shift = random.real(0, 3) * random.direction();
        const double squeeze = random.real(0.4, 1.5);
        for (Vec3& p : now.positions)
            p = Vec3(squeeze * p.x(), p.y(), p.z() + 0.2 * p.x() * p.x()) + (i % 2) * shift +
                random.real(0, 0.1) * random.direction();
        if (i % 3 == 0) // one vertex pulled out of the rest
            now.positions[17] += Vec3(0, 0, 5);
        double expected = 0;
        for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
            expected = std::max(expected, test::squared_distance(mesh, now.positions[v]));
            expected = std::max(expected, test::squared_distance(now, mesh.positions[v]));
        }
        CHECK(measure.measure(now.positions).hausdorff == Approx(std::sqrt(expected)));
    }
    CHECK(measure.measure(mesh.positions).hausdorff == 0.0);
    Points broken = mesh.positions;
    broken[3].x() = std::numeric_limits<double>::quiet_NaN();
    CHECK(std::isinf(measure.measure(broken).hausdorff));
    CHECK(RestDistanceMeasure({}, {Vec3(1, 2, 3)}).measure({Vec3(5, 5, 5)}).max == 0.0);
}

TEST_CASE("attachment drift", "[metrics][muscle_measure]") {
    const auto scene = test::scene_of(test::torus(30, 10), {test::box(1, 1, 1), test::box(1, 1, 1)});
    scene->muscles[0].attachments = {{AttachmentKind::origin, 0, {0, 1, 2}},
                                     {AttachmentKind::insertion, 1, {9, 40}}};
    const Points& rest = scene->muscles[0].mesh->positions;
    MuscleMeasure m = measure_of(*scene);
    const Pose turned = rotation_about(Vec3(1, 2, 3), Vec3(0, 1, 0), 0.5);
    Points points = rest;
    for (const std::size_t v : {9u, 40u})
        points[v] = turned.apply(rest[v]);
    points[20] += Vec3(50, 0, 0); // free
    m.measure(test::frame_of(*scene, points, {Pose{}, turned}));
    CHECK(m.attachment_drift_mm() < 1e-12);
    points[1] += Vec3(0, 0.25, 0);
    points[40] += Vec3(0, 0, -0.5);
    m.measure(test::frame_of(*scene, points, {Pose{}, turned}));
    CHECK(m.attachment_drift_mm() == Approx(0.5));
}
