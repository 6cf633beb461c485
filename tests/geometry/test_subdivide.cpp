#include "fascicle/geometry/mesh_check.hpp"
#include "fascicle/geometry/subdivide.hpp"
#include "fascicle/geometry/volume.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace fascicle;

TEST_CASE("subdividing keeps volume, area and topology and quarters triangles", "[geometry][subdivide]") {
    for (const TriMesh& mesh : {test::box(2, 3, 5), test::sphere(4.0, 2), test::torus()}) {
        const MeshTopology before(mesh.vertex_count(), mesh.triangles);
        const Subdivision fine = subdivide(mesh);
        const MeshTopology after(fine.mesh.vertex_count(), fine.mesh.triangles);
        CHECK(fine.mesh.triangles.size() == 4 * mesh.triangles.size());
        CHECK(fine.mesh.positions.size() == mesh.positions.size() + before.edges().size());
        CHECK(fine.parents == before.edges());
        // V - E + F and the number of parts do not change, and the surface stays closed and oriented.
        CHECK(fine.mesh.vertex_count() - int(after.edges().size()) + fine.mesh.triangle_count() ==
              mesh.vertex_count() - int(before.edges().size()) + mesh.triangle_count());
        CHECK(after.dihedrals().size() == after.edges().size());
        CHECK(after.component_count() == before.component_count());
        const double volume = signed_volume(mesh.positions, mesh.triangles);
        CHECK(signed_volume(fine.mesh.positions, fine.mesh.triangles) == Approx(volume).epsilon(1e-12));
        CHECK(surface_area(fine.mesh.positions, fine.mesh.triangles) ==
              Approx(surface_area(mesh.positions, mesh.triangles)).epsilon(1e-12));
    }
}

TEST_CASE("the four parts of a triangle lie in it, as large as each other", "[geometry][subdivide]") {
    const TriMesh mesh = test::sphere(3.0, 1);
    const Subdivision fine = subdivide(mesh);
    const auto normal = [](const TriMesh& m, std::size_t t) {
        const Vec3& a = m.positions[std::size_t(m.triangles[t][0])];
        return Vec3((m.positions[std::size_t(m.triangles[t][1])] - a)
                        .cross(m.positions[std::size_t(m.triangles[t][2])] - a));
    };
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (std::size_t k = 0; k < 4; ++k)
            CHECK((normal(fine.mesh, 4 * t + k) - normal(mesh, t) / 4).norm() < 1e-12);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        CHECK(fine.mesh.positions[i] == mesh.positions[i]);
}

TEST_CASE("labels go to new vertices whose ends share them, values are averaged", "[geometry][subdivide]") {
    const TriMesh mesh = test::box();
    std::vector<int> labels(8, -1);
    labels[0] = labels[1] = labels[3] = 0; // the floor but one corner
    labels[4] = labels[5] = labels[6] = labels[7] = 1;
    std::vector<double> heights;
    for (const Vec3& p : mesh.positions) {
        heights.push_back(p.z());
        heights.push_back(p.x());
    }
    const Subdivision fine = subdivide(mesh);
    const std::vector<int> finer = subdivided_labels(fine, labels);
    const std::vector<double> values = subdivided_values(fine, heights, 2);
    REQUIRE(finer.size() == fine.mesh.positions.size());
    REQUIRE(values.size() == 2 * fine.mesh.positions.size());
    int on_top = 0, on_floor = 0;
    for (std::size_t i = 0; i < finer.size(); ++i) {
        const Vec3& p = fine.mesh.positions[i];
        CHECK((finer[i] == 1) == (p.z() == 1.0)); // the top belongs to label 1 wholly
        on_top += finer[i] == 1;
        on_floor += finer[i] == 0;
        CHECK(values[2 * i] == p.z());
        CHECK(values[2 * i + 1] == p.x());
    }
    CHECK(on_top == 4 + 5);
    CHECK(on_floor == 3 + 3); // three corners and the three edges between them, the diagonal one included
}

TEST_CASE("subdividing copes with holes, unused vertices and repeated indices", "[geometry][subdivide]") {
    TriMesh mesh = test::sheet(2, 1);
    mesh.positions.emplace_back(9, 9, 9); // used by nobody
    mesh.triangles.push_back({0, 0, 1});
    const Subdivision fine = subdivide(mesh);
    CHECK(fine.mesh.triangles.size() == 16);
    CHECK(surface_area(fine.mesh.positions, fine.mesh.triangles) == Approx(2.0));
    CHECK(subdivide(TriMesh{}).mesh.triangles.empty());
}
