#include "fascicle/anatomy/harmonic_field.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace fascicle;

TEST_CASE("harmonic field: linear between two sides of a strip", "[anatomy][harmonic]") {
    const TriMesh mesh = test::sheet(9, 3);
    const MeshTopology topology(mesh.vertex_count(), mesh.triangles);
    std::vector<bool> fixed;
    std::vector<double> values;
    for (const Vec3& p : mesh.positions) {
        fixed.push_back(p.x() == 0.0 || p.x() == 9.0);
        values.push_back(fixed.back() ? p.x() / 9.0 : 0.0);
    }
    const auto field = solve_harmonic(mesh, topology, fixed, values, 1);
    for (std::size_t i = 0; i < field.size(); ++i)
        CHECK(field[i] == Approx(mesh.positions[i].x() / 9.0).margin(1e-5));
}

TEST_CASE("harmonic field: on a cone-free sphere the field between the poles is log tan",
          "[anatomy][harmonic]") {
    // Between two caps on a sphere the harmonic function of latitude is ln tan(colatitude / 2).
    const TriMesh mesh = test::sphere(1.0, 5);
    const MeshTopology topology(mesh.vertex_count(), mesh.triangles);
    const auto exact = [](const Vec3& p) { return std::log(std::tan(0.5 * std::acos(p.z()))); };
    std::vector<bool> fixed;
    std::vector<double> values;
    for (const Vec3& p : mesh.positions) {
        fixed.push_back(std::abs(p.z()) > 0.8);
        values.push_back(fixed.back() && std::abs(p.z()) < 1.0 ? exact(p) : 0.0);
    }
    const auto field = solve_harmonic(mesh, topology, fixed, values, 1);
    for (std::size_t i = 0; i < field.size(); ++i)
        if (std::abs(mesh.positions[i].z()) < 0.8)
            CHECK(field[i] == Approx(exact(mesh.positions[i])).margin(5e-3));
}

TEST_CASE("harmonic field: stays between the given values and solves several fields at once",
          "[anatomy][harmonic]") {
    TriMesh mesh = test::torus();
    for (Vec3& p : mesh.positions) // obtuse triangles: cotangents change sign
        p.z() *= 0.05;
    const MeshTopology topology(mesh.vertex_count(), mesh.triangles);
    std::vector<bool> fixed(mesh.positions.size(), false);
    std::vector<double> values(2 * fixed.size(), 0.0);
    fixed[0] = fixed[100] = true;
    values[0] = 1.0;
    values[2 * 100 + 1] = 1.0;
    const auto fields = solve_harmonic(mesh, topology, fixed, values, 2);
    for (std::size_t i = 0; i < fixed.size(); ++i) {
        CHECK(fields[2 * i] >= -1e-9);
        CHECK(fields[2 * i] <= 1 + 1e-9);
        CHECK(fields[2 * i] + fields[2 * i + 1] == Approx(1).margin(1e-9));
    }
}

TEST_CASE("harmonic field: parts without fixed vertices and unused vertices keep what was given",
          "[anatomy][harmonic]") {
    TriMesh mesh = test::joined(test::sphere(1.0, 1), test::sphere(1.0, 1, Vec3(5, 0, 0)));
    mesh.positions.emplace_back(9, 9, 9);
    const MeshTopology topology(mesh.vertex_count(), mesh.triangles);
    std::vector<bool> fixed(mesh.positions.size(), false);
    std::vector<double> values(fixed.size(), 7.0);
    fixed[0] = true;
    values[0] = 3.0;
    const auto field = solve_harmonic(mesh, topology, fixed, values, 1);
    CHECK(field[5] == Approx(3.0));
    CHECK(field[fixed.size() - 2] == 7.0);
    CHECK(field.back() == 7.0);
}

TEST_CASE("harmonic field: degenerate triangles do no harm", "[anatomy][harmonic]") {
    TriMesh mesh = test::sphere(1.0, 2);
    mesh.positions[10] = mesh.positions[mesh.triangles[0][0]]; // zero-area triangles
    const MeshTopology topology(mesh.vertex_count(), mesh.triangles);
    std::vector<bool> fixed(mesh.positions.size(), false);
    std::vector<double> values(fixed.size(), 0.0);
    fixed[0] = fixed[1] = true;
    values[1] = 1.0;
    for (const double u : solve_harmonic(mesh, topology, fixed, values, 1))
        CHECK(std::isfinite(u));
    for (const Vec3& g : triangle_gradients(mesh, values))
        CHECK(g.allFinite());
}

TEST_CASE("triangle gradients of a linear field are its slope", "[anatomy][harmonic]") {
    const TriMesh mesh = test::sheet(3, 3);
    std::vector<double> field;
    for (const Vec3& p : mesh.positions)
        field.push_back(2 * p.x() - 3 * p.y() + 1);
    for (const Vec3& g : triangle_gradients(mesh, field))
        CHECK((g - Vec3(2, -3, 0)).norm() < 1e-12);
}
