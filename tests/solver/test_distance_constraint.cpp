#include "solver/compliance.hpp"
#include "solver/constraints/distance.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>

using namespace fascicle;
using namespace fascicle::solver;

namespace {

const Vec3 a0(0.3, -1.2, 2.0), b0(1.7, 0.4, 1.1);

Points project_pair(Vec3 a, Vec3 b, double wa, double wb, double rest, double compliance,
                    double h = reference_substep_s) {
    DistanceConstraints constraints;
    constraints.add({0, 1, rest, compliance});
    Points x{a, b};
    constraints.project(x, {wa, wb}, h);
    return x;
}

} // namespace

TEST_CASE("distance: gradient agrees with central differences", "[solver][distance]") {
    const DistanceValue value = distance_value(a0, b0, 1.0);
    const double h = 1e-6;
    for (int k = 0; k < 3; ++k) {
        const Vec3 step = h * Vec3::Unit(k);
        const double da =
            (distance_value(a0 + step, b0, 1.0).value - distance_value(a0 - step, b0, 1.0).value) / (2 * h);
        const double db =
            (distance_value(a0, b0 + step, 1.0).value - distance_value(a0, b0 - step, 1.0).value) / (2 * h);
        CHECK(da == Approx(value.gradient_a[k]).margin(1e-9));
        CHECK(db == Approx(-value.gradient_a[k]).margin(1e-9));
    }
}

TEST_CASE("distance: zero at rest, and a projection leaves rest alone", "[solver][distance]") {
    const double rest = (a0 - b0).norm();
    CHECK(distance_value(a0, b0, rest).value == 0.0);
    const Points x = project_pair(a0, b0, 1, 1, rest, 0.0);
    CHECK(x[0] == a0);
    CHECK(x[1] == b0);
}

TEST_CASE("distance: unchanged by rigid motion", "[solver][distance]") {
    const Mat3 turn = Eigen::AngleAxisd(1.1, Vec3(1, 2, -1).normalized()).toRotationMatrix();
    const Vec3 shift(10, -3, 4);
    const DistanceValue before = distance_value(a0, b0, 1.5);
    const DistanceValue after = distance_value(turn * a0 + shift, turn * b0 + shift, 1.5);
    CHECK(after.value == Approx(before.value).margin(1e-12));
    CHECK((after.gradient_a - turn * before.gradient_a).norm() < 1e-12);
}

TEST_CASE("distance: momentum is kept for any masses, and a fixed end does not move", "[solver][distance]") {
    const double wa = 2.0, wb = 0.5;
    const Points x = project_pair(a0, b0, wa, wb, 1.0, 1e-7);
    CHECK(((x[0] - a0) / wa + (x[1] - b0) / wb).norm() < 1e-12);
    const Points fixed = project_pair(a0, b0, 0.0, 1.0, 1.0, 0.0);
    CHECK(fixed[0] == a0);
    CHECK((fixed[0] - fixed[1]).norm() == Approx(1.0));
    const Points both = project_pair(a0, b0, 0.0, 0.0, 1.0, 0.0);
    CHECK(both[1] == b0);
}

TEST_CASE("distance: one projection at the reference substep removes the share k of the error",
          "[solver][distance]") {
    const double k = GENERATE(0.1, 0.5, 0.9, 1.0);
    const double rest = 1.0, length = (a0 - b0).norm();
    const Points x = project_pair(a0, b0, 1, 1, rest, compliance_from_stiffness(k, 2.0));
    CHECK((x[0] - x[1]).norm() - rest == Approx((1.0 - k) * (length - rest)).margin(1e-12));
}

TEST_CASE("distance: a compliance means the same spring for any substep", "[solver][distance]") {
    // A unit mass on a fixed point, released from an extension: XPBD with small substeps must follow
    // x(t) = x0 cos(sqrt(1 / alpha) t), whatever the substep.
    const double alpha = 0.01, duration = 0.25;
    for (const int substeps : {2000, 8000}) {
        const double h = duration / substeps;
        DistanceConstraints constraints;
        constraints.add({0, 1, 1.0, alpha});
        Points x{Vec3::Zero(), Vec3(1.1, 0, 0)};
        Vec3 velocity = Vec3::Zero();
        for (int i = 0; i < substeps; ++i) {
            const Vec3 before = x[1];
            x[1] += h * velocity;
            constraints.project(x, {0.0, 1.0}, h);
            velocity = (x[1] - before) / h;
        }
        CHECK(x[1].x() - 1.0 ==
              Approx(0.1 * std::cos(duration / std::sqrt(alpha))).margin(40.0 / substeps * 0.1));
    }
}

TEST_CASE("distance: coincident points are left alone and stay finite", "[solver][distance]") {
    const Points x = project_pair(a0, a0, 1, 1, 1.0, 0.0);
    CHECK(x[0] == a0);
    CHECK(x[1] == a0);
    CHECK(distance_value(a0, a0, 0.0).gradient_a.allFinite());
    CHECK(project_pair(a0, a0 + Vec3(1e-12, 0, 0), 1, 1, 1.0, 0.0)[0].allFinite());
}

TEST_CASE("distance: points that passed each other are restored with the order they have now",
          "[solver][distance]") {
    // b came out on the other side of a: the constraint has no sign, it restores the length along the line they span.
    const Points x = project_pair(Vec3(1, 0, 0), Vec3(0, 0, 0), 1, 1, 2.0, 0.0);
    CHECK((x[0] - Vec3(1.5, 0, 0)).norm() < 1e-12);
    CHECK((x[1] - Vec3(-0.5, 0, 0)).norm() < 1e-12);
}

TEST_CASE("distance: stiffness 0 drops the constraint", "[solver][distance]") {
    DistanceConstraints constraints;
    constraints.add({0, 1, 1.0, compliance_from_stiffness(0.0, 2.0)});
    CHECK(constraints.size() == 0);
}
