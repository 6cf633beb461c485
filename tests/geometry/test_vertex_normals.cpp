#include "fascicle/geometry/vertex_normals.hpp"

#include "support/shapes.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;
using namespace fascicle::test;

TEST_CASE("Normals of a sphere are radial", "[geometry][vertex_normals]") {
    const TriMesh mesh = sphere(50.0, 4, Vec3(10, -20, 30));
    const Points normals = vertex_normals(mesh.positions, mesh.triangles);
    REQUIRE(normals.size() == mesh.positions.size());
    for (std::size_t i = 0; i < normals.size(); ++i) {
        CHECK(normals[i].norm() == Approx(1.0));
        CHECK(normals[i].dot((mesh.positions[i] - Vec3(10, -20, 30)) / 50.0) > 0.9995);
    }
    const TriMesh turned = inside_out(mesh);
    CHECK(vertex_normals(turned.positions, turned.triangles)[7].dot(normals[7]) == Approx(-1.0));
}

TEST_CASE("A cube's corner normal does not depend on its diagonals", "[geometry][vertex_normals]") {
    // Corners with one and with two triangles a side: an unweighted or area-weighted mean would lean.
    const TriMesh cube = box(2.0, 2.0, 2.0);
    const Points normals = vertex_normals(cube.positions, cube.triangles);
    for (std::size_t i = 0; i < 8; ++i) {
        const Vec3 expected = (cube.positions[i] - Vec3(1, 1, 1)).normalized();
        CHECK((normals[i] - expected).norm() < 1e-12);
    }
}

TEST_CASE("Points without usable triangles have a zero normal", "[geometry][vertex_normals]") {
    const Points points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}, {2, 0, 0}, {3, 0, 0}};
    const Points normals = vertex_normals(points, {{0, 1, 2}, {1, 4, 5}, {3, 3, 3}});
    CHECK((normals[0] - Vec3::UnitZ()).norm() < 1e-15);
    CHECK((normals[1] - Vec3::UnitZ()).norm() < 1e-15); // its second triangle has no area
    CHECK(normals[3] == Vec3::Zero());
    CHECK(normals[4] == Vec3::Zero());
    CHECK(vertex_normals({}, {}).empty());
    // Both sides of one sheet cancel
    CHECK(vertex_normals(points, {{0, 1, 2}, {0, 2, 1}})[0] == Vec3::Zero());
}
