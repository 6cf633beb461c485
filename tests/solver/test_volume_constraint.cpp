#include "solver/constraints/volume.hpp"
#include "support/shapes.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

using namespace fascicle;
using namespace fascicle::solver;

namespace {

Points moved(const Points& points, const Mat3& linear, const Vec3& shift) {
    Points result;
    for (const Vec3& p : points)
        result.push_back(linear * p + shift);
    return result;
}

Vec3 sum_of(const Points& points) {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& p : points)
        sum += p;
    return sum;
}

} // namespace

TEST_CASE("volume: closed forms of a tetrahedron and a box", "[solver][volume]") {
    const TriMesh tetrahedron = test::tetrahedron(3.0), box = test::box(2, 3, 4);
    CHECK(VolumeConstraint(tetrahedron.positions, tetrahedron.triangles, 1).rest_volume() == Approx(4.5));
    CHECK(VolumeConstraint(box.positions, box.triangles, 1).rest_volume() == Approx(24));
    const TriMesh inverted = test::inside_out(box);
    CHECK(VolumeConstraint(inverted.positions, inverted.triangles, 1).rest_volume() == Approx(-24));
}

TEST_CASE("volume: gradient agrees with central differences, far from the origin too", "[solver][volume]") {
    const TriMesh mesh = test::sphere(2.0, 1, Vec3(400, -300, 200));
    VolumeConstraint constraint(mesh.positions, mesh.triangles, 1);
    constraint.evaluate(mesh.positions);
    const Points gradient = constraint.gradient();
    const double h = 1e-5;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        for (int k = 0; k < 3; ++k) {
            Points plus = mesh.positions, minus = mesh.positions;
            plus[i][k] += h;
            minus[i][k] -= h;
            const double difference = (constraint.evaluate(plus) - constraint.evaluate(minus)) / (2 * h);
            CHECK(difference == Approx(gradient[i][k]).margin(1e-6));
        }
    CHECK(sum_of(gradient).norm() < 1e-12);
}

TEST_CASE("volume: unchanged by rigid motion, scaled by a linear map's determinant", "[solver][volume]") {
    const TriMesh mesh = test::sphere(1.0, 2);
    VolumeConstraint constraint(mesh.positions, mesh.triangles, 1);
    const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 1, 3).normalized()).toRotationMatrix();
    CHECK(constraint.evaluate(moved(mesh.positions, turn, Vec3(100, 50, -70))) ==
          Approx(constraint.rest_volume()).epsilon(1e-12));
    Mat3 stretch = Mat3::Identity();
    stretch(0, 0) = 2.5;
    stretch(0, 1) = 0.3;
    CHECK(constraint.evaluate(moved(mesh.positions, stretch, Vec3::Zero())) ==
          Approx(2.5 * constraint.rest_volume()));
}

TEST_CASE("volume: a projection leaves rest alone", "[solver][volume]") {
    const TriMesh mesh = test::sphere(1.0, 2, Vec3(3, 0, 0));
    VolumeConstraint constraint(mesh.positions, mesh.triangles, 1);
    Points x = mesh.positions;
    constraint.project(x, std::vector<double>(x.size(), 1.0));
    for (std::size_t i = 0; i < x.size(); ++i)
        CHECK((x[i] - mesh.positions[i]).norm() < 1e-14);
}

TEST_CASE("volume: one projection leaves an error of second order, the published 1/6 would leave 5/6",
          "[solver][volume]") {
    const TriMesh mesh = test::sphere(1.0, 3);
    const double squash = GENERATE(0.999, 0.99, 0.97);
    VolumeConstraint constraint(mesh.positions, mesh.triangles, 1);
    Points x = moved(mesh.positions, squash * Mat3::Identity(), Vec3::Zero());
    const double before = constraint.evaluate(x) / constraint.rest_volume() - 1.0;
    constraint.project(x, std::vector<double>(x.size(), 1.0));
    const double after = constraint.evaluate(x) / constraint.rest_volume() - 1.0;
    CHECK(std::abs(after) < before * before);
}

TEST_CASE("volume: pressure is the wanted multiple", "[solver][volume]") {
    const TriMesh mesh = test::sphere(1.0, 2);
    VolumeConstraint constraint(mesh.positions, mesh.triangles, 1.2);
    Points x = mesh.positions;
    for (int i = 0; i < 20; ++i)
        constraint.project(x, std::vector<double>(x.size(), 1.0));
    CHECK(constraint.evaluate(x) == Approx(1.2 * constraint.rest_volume()).epsilon(1e-12));
}

TEST_CASE("volume: momentum is kept and fixed points stay", "[solver][volume]") {
    const TriMesh mesh = test::sphere(1.0, 2);
    VolumeConstraint constraint(mesh.positions, mesh.triangles, 1);
    const Points start = moved(mesh.positions, 0.8 * Mat3::Identity(), Vec3::Zero());
    Points x = start;
    constraint.project(x, std::vector<double>(x.size(), 1.0));
    CHECK((sum_of(x) - sum_of(start)).norm() < 1e-11);

    std::vector<double> inverse_mass(x.size(), 1.0);
    for (std::size_t i = 0; i < x.size(); i += 3)
        inverse_mass[i] = 0.0;
    x = start;
    for (int i = 0; i < 20; ++i)
        constraint.project(x, inverse_mass);
    for (std::size_t i = 0; i < x.size(); i += 3)
        CHECK(x[i] == start[i]);
    CHECK(constraint.evaluate(x) == Approx(constraint.rest_volume()).epsilon(1e-9));
}

TEST_CASE("volume: flat, collapsed and inverted bodies stay finite, and inverted ones come back out",
          "[solver][volume]") {
    const TriMesh mesh = test::sphere(1.0, 2);
    VolumeConstraint constraint(mesh.positions, mesh.triangles, 1);
    const std::vector<double> inverse_mass(mesh.positions.size(), 1.0);
    Points point(mesh.positions.size(), Vec3(1, 2, 3));
    constraint.project(point, inverse_mass); // no gradient at all: nothing to do
    CHECK(point.front() == Vec3(1, 2, 3));
    Points none = mesh.positions;
    constraint.project(none, std::vector<double>(none.size(), 0.0));
    CHECK(none == mesh.positions);
    Points inverted = moved(mesh.positions, -0.5 * Mat3::Identity(), Vec3::Zero());
    CHECK(constraint.evaluate(inverted) < 0);
    for (int i = 0; i < 200; ++i)
        constraint.project(inverted, inverse_mass);
    CHECK(inverted.front().allFinite());
    CHECK(constraint.evaluate(inverted) == Approx(constraint.rest_volume()).epsilon(1e-6));
}
