#include "fascicle/geometry/iso_surface.hpp"
#include "fascicle/geometry/primitives.hpp"
#include "surface_checks.hpp"

#include "fascicle/base/error.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;

namespace {
const double pi = 3.14159265358979323846;
}

TEST_CASE("the extracted surface of a ball is closed, outward and of the right volume",
          "[geometry][iso_surface]") {
    // 10 / 0.5 puts nodes exactly on the surface: value 0 must not give triangles without area.
    const auto ball = sphere_shape(Vec3::Zero(), 10.0);
    const TriMesh mesh =
        extract_iso_surface(ImplicitField(ball, {Vec3::Constant(-12), Vec3::Constant(12), 0.5}, 1));
    const auto r = test::report(mesh);
    CHECK(r.closed);
    CHECK(r.one_fan);
    CHECK(r.euler == 2);
    CHECK(r.volume == Approx(4.0 / 3.0 * pi * 1000.0).epsilon(0.01));
    CHECK(r.shortest_edge > 1e-3);
}

TEST_CASE("noise still gives a closed manifold surface, also where the box cuts it",
          "[geometry][iso_surface]") {
    // A hash of the place: every configuration of corners occurs.
    const auto noise = [](const Vec3& p) {
        const double s = std::sin(12.9898 * p.x() + 78.233 * p.y() + 37.719 * p.z()) * 43758.5453;
        return s - std::floor(s) - 0.5;
    };
    const TriMesh mesh =
        extract_iso_surface(ImplicitField(noise, {Vec3::Zero(), Vec3::Constant(12), 1.0, 1e6}, 1));
    REQUIRE(mesh.triangle_count() > 2000);
    const auto r = test::report(mesh);
    CHECK(r.closed);
    CHECK(r.one_fan);
    CHECK(r.volume > 0.0);
    const TriMesh part = largest_component(mesh);
    CHECK(part.triangle_count() < mesh.triangle_count());
    CHECK(test::report(part).closed);
}

TEST_CASE("a meshed implicit has the wanted count, good triangles and lies on the surface",
          "[geometry][iso_surface][remesh]") {
    ImplicitMeshOptions options;
    const auto meshed = [&](const Implicit& f) {
        return mesh_implicit(
            f, ImplicitField(f, {Vec3::Constant(-14), Vec3::Constant(14), 1.0}, options.threads), options);
    };
    options.threads = 2;
    const Vec3 inner(0, 0, 0);
    struct Row {
        Implicit f;
        int triangles, euler;
        double volume, tolerance;
    };
    const std::vector<Row> rows{
        {sphere_shape(inner, 10.0), 2000, 2, 4.0 / 3.0 * pi * 1000.0, 0.01},
        {sphere_shape(inner, 10.0), 12000, 2, 4.0 / 3.0 * pi * 1000.0, 0.01}, // finer than the grid
        {ring_shape(inner, Vec3::UnitZ(), Vec3::UnitX(), pi, 9.0, 3.0), 3000, 0, 2.0 * pi * pi * 9.0 * 9.0,
         0.015},
        {ellipsoid_shape(inner, Vec3(12, 8, 3)), 3000, 2, 4.0 / 3.0 * pi * 12 * 8 * 3, 0.01}};
    for (const Row& row : rows) {
        INFO("wanted volume " << row.volume);
        options.triangles = row.triangles;
        const TriMesh mesh = meshed(row.f);
        const auto r = test::report(mesh);
        CHECK(mesh.triangle_count() == row.triangles);
        CHECK(r.closed);
        CHECK(r.one_fan);
        CHECK(r.euler == row.euler);
        CHECK(r.volume == Approx(row.volume).epsilon(row.tolerance));
        CHECK(r.min_angle_deg > 15.0);
        CHECK(r.mean_quality > 0.93);
        CHECK(r.longest_edge / r.shortest_edge < 6.0);
        double worst = 0.0;
        for (const Vec3& p : mesh.positions)
            worst = std::max(worst, std::abs(row.f(p)));
        CHECK(worst < 1e-3);
        options.threads = 3 - options.threads;
        CHECK(meshed(row.f).positions == mesh.positions);
    }
    options.triangles = 100;
    CHECK_THROWS_AS(meshed(sphere_shape(Vec3(99, 0, 0), 1.0)), Error);
}

TEST_CASE("remeshing a box keeps it closed and reaches few and many triangles", "[geometry][remesh]") {
    const TriMesh box = box_mesh(Vec3(0, 0, 0), Vec3(4, 5, 6), {4, 5, 6});
    for (const int wanted : {60, 301, 296, 5000}) {
        const TriMesh mesh = remesh(box, {wanted, 3, {}});
        const auto r = test::report(mesh);
        CHECK(mesh.triangle_count() == wanted / 2 * 2);
        CHECK(r.closed);
        CHECK(r.one_fan);
        CHECK(r.euler == 2);
        CHECK(r.volume > 60.0);
    }
}

TEST_CASE("a box mesh has the counts and volume of its formula", "[geometry][primitives]") {
    const TriMesh box = box_mesh(Vec3(-1, 2, 3), Vec3(4, 4, 10), {3, 1, 5});
    const auto r = test::report(box);
    CHECK(box.triangle_count() == 4 * (3 * 1 + 1 * 5 + 5 * 3));
    CHECK(box.vertex_count() == 2 + box.triangle_count() / 2);
    CHECK(r.closed);
    CHECK(r.one_fan);
    CHECK(r.euler == 2);
    CHECK(r.volume == Approx(5.0 * 2.0 * 7.0));
}

TEST_CASE("a cylinder mesh is closed and its volume that of the prism inside the cylinder",
          "[geometry][primitives]") {
    const TriMesh mesh = cylinder_mesh(Vec3(1, 2, 3), Vec3(1, 8, 3), 2.0, 40, 5);
    const auto r = test::report(mesh);
    CHECK(mesh.triangle_count() == 2 * 40 * 6);
    CHECK(r.closed);
    CHECK(r.one_fan);
    CHECK(r.euler == 2);
    CHECK(r.volume == Approx(0.5 * 40 * std::sin(2.0 * pi / 40) * 4.0 * 6.0));
}
