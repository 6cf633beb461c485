// The angle and its gradients have their own tests (geometry/test_dihedral_angle.cpp); here: the constraint on them.
#include "fascicle/geometry/dihedral_angle.hpp"
#include "solver/compliance.hpp"
#include "solver/constraints/dihedral.hpp"
#include "support/shapes.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

using namespace fascicle;
using namespace fascicle::solver;

namespace {

constexpr double reference = reference_substep_s;

/// Two triangles over the edge (0,0,0)-(0,1,0), the second wing turned up by `angle` from flat.
Points pair(double angle) {
    return {Vec3(1, 0.4, 0), Vec3(-std::cos(angle), 0.6, std::sin(angle)), Vec3(0, 0, 0), Vec3(0, 1, 0)};
}

const std::vector<Dihedral> one{{0, 1, 2, 3, 0}};

double angle_of(const Points& x) {
    return signed_dihedral_angle(x[0], x[1], x[2], x[3]).value();
}

DihedralConstraints make(double rest_angle, double stiffness) {
    return DihedralConstraints(pair(rest_angle), one, stiffness);
}

const std::vector<double> all_free(4, 1.0);

} // namespace

TEST_CASE("dihedral constraint: rest is left alone", "[solver][dihedral]") {
    const double rest = GENERATE(-2.5, -0.8, 0.0, 0.8, 2.5);
    const DihedralConstraints constraints = make(rest, 0.9);
    Points x = pair(rest);
    constraints.project(x, all_free, reference);
    for (std::size_t i = 0; i < 4; ++i)
        CHECK((x[i] - pair(rest)[i]).norm() < 1e-14);
}

TEST_CASE("dihedral constraint: near rest one projection removes the share k", "[solver][dihedral]") {
    const double k = GENERATE(0.1, 0.3, 0.9, 1.0);
    const double rest = GENERATE(-1.2, 0.0, 1.2);
    const DihedralConstraints constraints = make(rest, k);
    const double error = 1e-4;
    Points x = pair(rest + error);
    const double before = angle_of(x) - angle_of(pair(rest));
    constraints.project(x, all_free, reference);
    const double after = angle_of(x) - angle_of(pair(rest));
    CHECK(after == Approx((1.0 - k) * before).margin(2e-3 * error));
}

TEST_CASE("dihedral constraint: momentum and angular momentum are kept", "[solver][dihedral]") {
    const DihedralConstraints constraints = make(0.7, 0.8);
    const Points before = pair(-0.9);
    Points x = before;
    constraints.project(x, all_free, reference);
    Vec3 momentum = Vec3::Zero(), angular = Vec3::Zero();
    for (std::size_t i = 0; i < 4; ++i) {
        momentum += x[i] - before[i];
        angular += before[i].cross(x[i] - before[i]);
    }
    CHECK((x[0] - before[0]).norm() > 1e-3);
    CHECK(momentum.norm() < 1e-14);
    CHECK(angular.norm() < 1e-14);
}

TEST_CASE("dihedral constraint: turns with the pair, and scale and substep do not matter to k",
          "[solver][dihedral]") {
    const Mat3 turn = Eigen::AngleAxisd(2.0, Vec3(1, -1, 0.4).normalized()).toRotationMatrix();
    const double scale = GENERATE(1e-3, 1.0, 1e3);
    Points rest = pair(0.3), x = pair(0.5), y;
    const DihedralConstraints plain(rest, one, 0.5);
    for (const Vec3& p : x)
        y.push_back(scale * (turn * p) + Vec3(5, 6, 7) * scale);
    for (Vec3& p : rest)
        p *= scale;
    const DihedralConstraints scaled(rest, one, 0.5);
    plain.project(x, all_free, reference);
    scaled.project(y, all_free, reference);
    for (std::size_t i = 0; i < 4; ++i)
        CHECK((scale * (turn * x[i]) + Vec3(5, 6, 7) * scale - y[i]).norm() < 1e-11 * scale);
}

TEST_CASE("dihedral constraint: a crease that turned inside out is turned back", "[solver][dihedral]") {
    // The acos form of the paper calls this satisfied.
    const DihedralConstraints constraints = make(0.8, 1.0);
    Points x = pair(-0.8);
    CHECK(angle_of(x) == Approx(-angle_of(pair(0.8))));
    for (int i = 0; i < 50; ++i)
        constraints.project(x, all_free, reference);
    CHECK(angle_of(x) == Approx(angle_of(pair(0.8))).margin(1e-9));
}

TEST_CASE("dihedral constraint: unfolds across the jump at a full fold the short way", "[solver][dihedral]") {
    const double pi = std::numbers::pi;
    const DihedralConstraints constraints = make(pi - 0.2, 1.0);
    Points x = pair(-pi + 0.2); // 0.4 rad away through the fold, 5.9 rad the other way
    for (int i = 0; i < 50; ++i)
        constraints.project(x, all_free, reference);
    CHECK(angle_of(x) == Approx(angle_of(pair(pi - 0.2))).margin(1e-9));
}

TEST_CASE("dihedral constraint: one projection corrects no more than its limit", "[solver][dihedral]") {
    const DihedralConstraints constraints = make(0.0, 1.0);
    Points x = pair(2.5);
    const double before = std::abs(angle_of(x));
    constraints.project(x, all_free, reference);
    CHECK(std::abs(angle_of(x)) < before);
    CHECK(std::abs(angle_of(x)) > before - 2.0 * max_correction_rad);
}

TEST_CASE("dihedral constraint: slivers and collapsed triangles are skipped, never NaN",
          "[solver][dihedral]") {
    const DihedralConstraints constraints = make(0.4, 0.9);
    Points sliver = pair(0.4);
    sliver[0] = Vec3(1e-3, 0.5, 0); // height a thousandth of the edge
    Points before = sliver;
    CHECK(constraints.project(sliver, all_free, reference) == 1);
    CHECK(sliver == before);
    Points collapsed(4, Vec3(1, 1, 1));
    before = collapsed;
    CHECK(constraints.project(collapsed, all_free, reference) == 1);
    CHECK(collapsed == before);
    CHECK(DihedralConstraints(collapsed, one, 0.9).size() == 0);
    CHECK(make(0.4, 0.0).size() == 0);
}

TEST_CASE("dihedral constraint: fixed points stay, the others do the work", "[solver][dihedral]") {
    const DihedralConstraints constraints = make(0.0, 1.0);
    Points x = pair(0.3);
    const Points before = x;
    for (int i = 0; i < 20; ++i)
        constraints.project(x, {0, 1, 0, 0}, reference);
    CHECK(x[0] == before[0]);
    CHECK(x[2] == before[2]);
    CHECK(angle_of(x) == Approx(0).margin(1e-9));
    Points all_fixed = pair(0.3);
    constraints.project(all_fixed, {0, 0, 0, 0}, reference);
    CHECK(all_fixed == pair(0.3));
}

TEST_CASE("dihedral constraint: noise on a sphere is smoothed away", "[solver][dihedral]") {
    const TriMesh mesh = test::sphere(10.0, 2);
    const MeshTopology topology(mesh.vertex_count(), mesh.triangles);
    const DihedralConstraints constraints(mesh.positions, topology.dihedrals(), 0.5);
    std::mt19937 random(5);
    std::normal_distribution<double> noise(0.0, 0.1);
    Points x = mesh.positions;
    for (Vec3& p : x)
        p += Vec3(noise(random), noise(random), noise(random));
    const auto error = [&] {
        double sum = 0;
        for (const DihedralConstraint& c : constraints.items()) {
            const auto at = [&](std::size_t k) { return x[static_cast<std::size_t>(c.p[k])]; };
            const double change = signed_dihedral_angle(at(0), at(1), at(2), at(3)).value() - c.rest_rad;
            sum += change * change;
        }
        return std::sqrt(sum / double(constraints.size()));
    };
    const double before = error();
    for (int i = 0; i < 60; ++i)
        constraints.project(x, std::vector<double>(x.size(), 1.0), reference);
    CHECK(error() < 0.05 * before);
}
