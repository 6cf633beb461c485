#include "fascicle/base/pose.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>

using namespace fascicle;

namespace {

double difference(const Pose& a, const Pose& b) {
    return (a.rotation - b.rotation).norm() + (a.translation - b.translation).norm();
}

const Pose from = rotation_about(Vec3(10, -4, 3), Vec3(1, 1, 0), 0.4);

} // namespace

TEST_CASE("pose: inverse and composition", "[base][pose]") {
    const Pose b = rotation_about(Vec3(0, 5, 1), Vec3(0, 1, 3), -1.2);
    const Vec3 x(3, 2, 1);
    CHECK((from.after(b).apply(x) - from.apply(b.apply(x))).norm() < 1e-13);
    CHECK((from.inverse().apply(from.apply(x)) - x).norm() < 1e-13);
    CHECK((from.apply_inverse(from.apply(x)) - x).norm() < 1e-13);
}

TEST_CASE("pose: a rotation keeps its centre and follows the right-hand rule", "[base][pose]") {
    const Pose turn = rotation_about(Vec3(1, 2, 3), Vec3(0, 0, 5), std::acos(0.0));
    CHECK((turn.apply(Vec3(1, 2, 3)) - Vec3(1, 2, 3)).norm() < 1e-14);
    CHECK((turn.apply(Vec3(2, 2, 7)) - Vec3(1, 3, 7)).norm() < 1e-14);
}

TEST_CASE("screw: both ends are exact", "[base][pose]") {
    const Pose to = rotation_about(Vec3(0, 1, 0), Vec3(3, 1, 0), 1.0);
    CHECK(difference(screw_between(from, to, 0), from) == 0);
    CHECK(difference(screw_between(from, to, 1), to) == 0);
    CHECK(difference(screw_between(from, to, 1 - 1e-12), to) < 1e-10);
}

TEST_CASE("screw: between two turns about one axis it is the turn by the share", "[base][pose]") {
    const Vec3 centre(143.86, 243.37, -432.53), axis(1, 0.2, 0);
    const Pose a = rotation_about(centre, axis, 0.3), b = rotation_about(centre, axis, 0.9);
    for (const double s : {0.25, 0.5, 0.9})
        CHECK(difference(screw_between(a, b, s), rotation_about(centre, axis, 0.3 + 0.6 * s)) < 1e-10);
}

TEST_CASE("screw: equal rotations give a straight shift, also for almost no turn", "[base][pose]") {
    Pose to = from;
    to.translation += Vec3(1, -2, 4);
    CHECK((screw_between(from, to, 0.5).translation - from.translation - Vec3(0.5, -1, 2)).norm() < 1e-12);
    const Pose tiny = rotation_about(Vec3(1, 2, 3), Vec3(0, 1, 0), 1e-9).after(to);
    const Pose half = screw_between(from, tiny, 0.5);
    CHECK((half.apply(Vec3(1, 1, 1)) - 0.5 * (from.apply(Vec3(1, 1, 1)) + tiny.apply(Vec3(1, 1, 1)))).norm() <
          1e-6);
}

TEST_CASE("screw: a helix, and two halves make the whole", "[base][pose]") {
    Pose helix = rotation_about(Vec3(5, 0, 0), Vec3(0, 0, 1), 1.0);
    helix.translation += Vec3(0, 0, 7);
    const Pose half = screw_between(Pose{}, helix, 0.5);
    CHECK(half.apply(Vec3(5, 0, 0)).z() == Approx(3.5));
    CHECK(difference(half.after(half), helix) < 1e-12);
}

TEST_CASE("an axis has a direction where its length has all its digits", "[base][pose]") {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    for (const double length : {1e-150, 1e-9, 1.0, 1e150}) {
        const Vec3 v = length * Vec3(2, -3, 6);
        REQUIRE(has_direction(v));
        CHECK((v.normalized() - Vec3(2, -3, 6) / 7).norm() < 1e-15);
    }
    for (const double length : {0.0, 1e-320, 1e-160, 1e160, infinite, std::nan("")})
        CHECK_FALSE(has_direction(Vec3(0, length, length)));
}
