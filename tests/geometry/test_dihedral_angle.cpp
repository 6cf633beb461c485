#include "fascicle/geometry/dihedral_angle.hpp"

#include "fascicle/base/pose.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

using namespace fascicle;

namespace {

constexpr double pi = std::numbers::pi;
using Four = std::array<Vec3, 4>;

std::optional<double> signed_of(const Four& p) {
    return signed_dihedral_angle(p[0], p[1], p[2], p[3]);
}

/// Edge along y, wing p0 at -x, wing p1 turned about the edge by `turn` from its flat place at +x; both
/// normals +z when flat. A positive turn lifts the wing: a valley.
Four hinge(double turn) {
    return {Vec3(-2.0, 0.3, 0.0), Vec3(1.5 * std::cos(turn), 0.6, 1.5 * std::sin(turn)), Vec3(0, 0, 0),
            Vec3(0, 1.2, 0)};
}

Four random_hinge(std::mt19937& random) {
    std::uniform_real_distribution<double> in(-1.0, 1.0);
    Four p;
    for (Vec3& x : p)
        x = Vec3(in(random), in(random), in(random));
    return p;
}

} // namespace

TEST_CASE("dihedral angle: flat is 0, valley positive, ridge negative, up to the full fold",
          "[geometry][dihedral_angle]") {
    for (const double turn : {-3.1, -pi / 2, -1.0, -1e-5, 0.0, 1e-9, 0.3, pi / 2, 2.0, 3.14}) {
        INFO("turn " << turn);
        const Four p = hinge(turn);
        CHECK(signed_of(p).value() == Approx(turn).margin(1e-12));
        // acos loses half the digits near 0 and pi.
        CHECK(unsigned_dihedral_angle(p[0], p[1], p[2], p[3]).value() == Approx(std::abs(turn)).margin(3e-8));
        // The same hinge met from its other triangle, and with every triangle inside out.
        CHECK(signed_dihedral_angle(p[1], p[0], p[3], p[2]).value() == Approx(turn).margin(1e-12));
        CHECK(signed_dihedral_angle(p[0], p[1], p[3], p[2]).value() == Approx(-turn).margin(1e-12));
    }
    CHECK(std::abs(signed_of(hinge(pi)).value()) == Approx(pi));
}

TEST_CASE("dihedral angle of a cube's edge and of a regular tetrahedron's", "[geometry][dihedral_angle]") {
    // Cube [0,1]^3: top face (z = 1) and the face x = 1 meet in the edge (1,0,1)-(1,1,1); outward normals.
    CHECK(signed_dihedral_angle(Vec3(0, 0, 1), Vec3(1, 1, 0), Vec3(1, 0, 1), Vec3(1, 1, 1)).value() ==
          Approx(-pi / 2));
    const Vec3 a(1, 1, 1), b(1, -1, -1), c(-1, 1, -1), d(-1, -1, 1);
    // Triangles (a, b, c) and (d, c, b) seen from outside; the inner angle is acos(1/3).
    const Vec3 outward = (b - a).cross(c - a);
    REQUIRE(outward.dot(a) > 0);
    CHECK(signed_dihedral_angle(a, d, b, c).value() == Approx(-(pi - std::acos(1.0 / 3.0))));
}

TEST_CASE("dihedral gradient agrees with central differences", "[geometry][dihedral_angle]") {
    std::mt19937 random(7);
    int tried = 0;
    while (tried < 300) {
        Four p = random_hinge(random);
        const auto exact = dihedral_angle_with_gradient(p[0], p[1], p[2], p[3]);
        REQUIRE(exact);
        double largest = 0.0;
        for (const Vec3& g : exact->gradient)
            largest = std::max(largest, g.norm());
        if (largest > 20.0) // nearly degenerate: the difference quotient is the poor one there
            continue;
        ++tried;
        CHECK(exact->angle_rad == signed_of(p).value());
        const double h = 1e-6;
        for (std::size_t i = 0; i < 4; ++i) {
            for (int k = 0; k < 3; ++k) {
                Four lo = p, hi = p;
                lo[i][k] -= h;
                hi[i][k] += h;
                const double difference = wrap_angle(signed_of(hi).value() - signed_of(lo).value()) / (2 * h);
                REQUIRE(exact->gradient[i][k] == Approx(difference).margin(2e-6));
            }
        }
    }
}

TEST_CASE("dihedral gradients sum to zero, carry no torque, and turn with the hinge",
          "[geometry][dihedral_angle]") {
    std::mt19937 random(11);
    for (int n = 0; n < 200; ++n) {
        const Four p = random_hinge(random);
        const auto before = dihedral_angle_with_gradient(p[0], p[1], p[2], p[3]).value();
        Vec3 sum = Vec3::Zero(), torque = Vec3::Zero();
        double scale = 0.0;
        for (std::size_t i = 0; i < 4; ++i) {
            sum += before.gradient[i];
            torque += p[i].cross(before.gradient[i]);
            scale += before.gradient[i].norm();
        }
        CHECK(sum.norm() < 1e-12 * scale);
        CHECK(torque.norm() < 1e-12 * scale);
        Pose pose = rotation_about(Vec3(3, -2, 1), Vec3(1, 2, -0.5), 2.1);
        pose.translation += Vec3(10, -20, 30);
        Four q;
        for (std::size_t i = 0; i < 4; ++i)
            q[i] = pose.apply(p[i]);
        const auto after = dihedral_angle_with_gradient(q[0], q[1], q[2], q[3]).value();
        CHECK(after.angle_rad == Approx(before.angle_rad).margin(1e-9 * (1 + scale)));
        for (std::size_t i = 0; i < 4; ++i)
            CHECK((after.gradient[i] - pose.rotation * before.gradient[i]).norm() <
                  1e-9 * (1 + scale * scale));
    }
}

TEST_CASE("degenerate hinges are skipped whatever the unit", "[geometry][dihedral_angle]") {
    const double unit = GENERATE(1e-6, 1.0, 1e6);
    const Vec3 a(0, 0, 0), b(0, unit, 0), wing(unit, 0, 0);
    const auto none = [](const Vec3& p0, const Vec3& p1, const Vec3& p2, const Vec3& p3) {
        return !signed_dihedral_angle(p0, p1, p2, p3) && !unsigned_dihedral_angle(p0, p1, p2, p3) &&
               !dihedral_angle_with_gradient(p0, p1, p2, p3);
    };
    CHECK(none(wing, Vec3(0, 0.5 * unit, 0), a, b));         // wing on the edge
    CHECK(none(Vec3(0.5e-6 * unit, 0, 0), wing, a, b));      // height below 1e-6 of the edge
    CHECK_FALSE(none(Vec3(-2e-6 * unit, 0, 0), wing, a, b)); // just above: still an angle
    CHECK(none(wing, -wing, a, a));                          // no edge
    CHECK(none(a, a, a, a));                                 // nothing at all
    CHECK(none(Vec3(std::numeric_limits<double>::quiet_NaN(), 0, 0), wing, a, b));
}

TEST_CASE("wrap_angle brings differences above -pi and up to pi", "[geometry][dihedral_angle]") {
    CHECK(wrap_angle(0.0) == 0.0);
    CHECK(wrap_angle(pi) == Approx(pi));
    CHECK(wrap_angle(-pi) == Approx(pi));
    CHECK(wrap_angle(3.0 - -3.0) == Approx(6.0 - 2 * pi));
    CHECK(wrap_angle(7 * pi + 0.25) == Approx(-pi + 0.25));
}
