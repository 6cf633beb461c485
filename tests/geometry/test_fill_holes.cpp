#include "fascicle/geometry/axis_mapping.hpp"
#include "fascicle/geometry/fill_holes.hpp"
#include "fascicle/geometry/mesh_check.hpp"
#include "fascicle/geometry/volume.hpp"
#include "support/shapes.hpp"

#include <Eigen/LU>
#include <catch2/catch.hpp>

using namespace fascicle;

TEST_CASE("A box without a side gets it back, flat and facing outwards", "[geometry][fill_holes]") {
    TriMesh mesh = test::box(2, 3, 4);
    mesh.triangles.resize(mesh.triangles.size() - 2); // the side x = 2
    const HoleFilling filling = fill_holes(mesh);
    CHECK(filling.filled == 1);
    CHECK(filling.left == 0);
    CHECK(filling.triangles == 2);
    CHECK(filling.added_area == Approx(12));
    CHECK(filling.surface_area == Approx(2 * (6 + 8 + 12)));
    CHECK(check_mesh(filling.mesh).closed());
    CHECK(signed_volume(filling.mesh.positions, filling.mesh.triangles) == Approx(24));
    CHECK(filling.mesh.positions == mesh.positions);
}

TEST_CASE("Several holes of a sphere are filled, longer ones than allowed stay", "[geometry][fill_holes]") {
    TriMesh mesh = test::sphere(1, 3);
    const auto around = [](const Tri& t, int v) { return t[0] == v || t[1] == v || t[2] == v; };
    std::erase_if(mesh.triangles, [&](const Tri& t) { return around(t, 0) || around(t, 3); });
    const double full = signed_volume(test::sphere(1, 3).positions, test::sphere(1, 3).triangles);
    const HoleFilling filling = fill_holes(mesh);
    CHECK(filling.filled == 2);
    const MeshReport report = check_mesh(filling.mesh);
    CHECK(report.closed());
    CHECK(report.nonmanifold_edges == 0);
    CHECK(report.inconsistent_triangles == 0);
    const double volume = signed_volume(filling.mesh.positions, filling.mesh.triangles);
    CHECK(volume < full); // chords lie inside of the sphere
    CHECK(volume > 0.98 * full);
    CHECK(fill_holes(mesh, 3).filled == 0);
    CHECK(fill_holes(mesh, 3).left == 2);
    CHECK(fill_holes(test::sphere(1, 2)).triangles == 0); // nothing to do
}

TEST_CASE("Holes that touch in a vertex stay as they are", "[geometry][fill_holes]") {
    TriMesh mesh = test::sphere(1, 2);
    // Two triangles opposite each other at vertex 0: their holes share it.
    std::vector<std::size_t> at;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (const int v : mesh.triangles[t])
            if (v == 0)
                at.push_back(t);
    REQUIRE(at.size() == 4);
    const auto shared = [&](std::size_t a, std::size_t b) {
        int count = 0;
        for (const int v : mesh.triangles[a])
            for (const int w : mesh.triangles[b])
                count += v == w ? 1 : 0;
        return count;
    };
    std::size_t other = 1;
    while (shared(at[0], at[other]) > 1)
        ++other;
    mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(at[other]));
    mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(at[0]));
    const HoleFilling filling = fill_holes(mesh);
    CHECK(filling.triangles == 0);
    CHECK(filling.left >= 1);
    CHECK(filling.mesh.triangles == mesh.triangles);
}

TEST_CASE("Axis mappings are rotations, and OpenSim's is its inverse's inverse", "[geometry][axis_mapping]") {
    for (const AxisMappingRow& row : axis_mappings()) {
        const Mat3 m = axis_matrix(row.mapping);
        CHECK(m.determinant() == 1);
        CHECK((m * m.transpose() - Mat3::Identity()).norm() == 0);
        const TriMesh mesh = mapped(test::tetrahedron(2), row.mapping, 10);
        CHECK(signed_volume(mesh.positions, mesh.triangles) == Approx(8.0 / 6 * 1000));
    }
    CHECK(axis_matrix(AxisMapping::opensim_to_lps) * axis_matrix(AxisMapping::lps_to_opensim) ==
          Mat3::Identity());
    // X anterior (-y), Y up (z), Z right (-x).
    CHECK(axis_matrix(AxisMapping::lps_to_opensim) * Vec3(0, -1, 0) == Vec3(1, 0, 0));
    CHECK(axis_matrix(AxisMapping::lps_to_opensim) * Vec3(0, 0, 1) == Vec3(0, 1, 0));
    CHECK(axis_matrix(AxisMapping::lps_to_opensim) * Vec3(-1, 0, 0) == Vec3(0, 0, 1));
    CHECK(axis_matrix(AxisMapping::y_up_to_lps) * axis_matrix(AxisMapping::lps_to_y_up) == Mat3::Identity());
    CHECK(axis_matrix(AxisMapping::lps_to_y_up) * Vec3(1, 2, 3) == Vec3(1, 3, -2)); // as glTF is written
    CHECK(axis_matrix(AxisMapping::ras_to_lps) * Vec3(1, 1, 1) == Vec3(-1, -1, 1));
}
