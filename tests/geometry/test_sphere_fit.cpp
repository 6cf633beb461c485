#include "fascicle/geometry/sphere_fit.hpp"
#include "geometry/surface_oracles.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;

namespace {

MeshPtr shared(TriMesh mesh) {
    return std::make_shared<const TriMesh>(std::move(mesh));
}

/// A cup around the ball of radius r at the origin: the upper part of a larger ball's surface and of a
/// smaller one's.
TriMesh cup(double inner, double outer) {
    TriMesh mesh = test::joined(test::sphere(outer, 4), test::inside_out(test::sphere(inner, 4)));
    std::erase_if(mesh.triangles, [&](const Tri& t) {
        return mesh.positions[static_cast<std::size_t>(t[0])].z() < 0.1 * inner;
    });
    return mesh;
}

/// A ball on a stick along -z: a box grown out of it, as one surface soup.
TriMesh ball_on_stick(double r) {
    TriMesh mesh = test::sphere(r, 4);
    std::erase_if(mesh.triangles, [&](const Tri& t) {
        return mesh.positions[static_cast<std::size_t>(t[0])].z() < -0.8 * r;
    });
    TriMesh stick = test::box(r, r, 8 * r);
    for (Vec3& p : stick.positions)
        p -= Vec3(0.5 * r, 0.5 * r, 8.7 * r);
    return test::joined(mesh, stick);
}

TriMesh moved(TriMesh mesh, double scale, const Vec3& shift) {
    for (Vec3& p : mesh.positions)
        p = scale * p + shift;
    return mesh;
}

} // namespace

TEST_CASE("a sphere from exact and from noisy points", "[geometry][sphere_fit]") {
    test::Random random(1);
    const Vec3 centre(120, -340, 77);
    Points exact, noisy;
    for (int i = 0; i < 400; ++i) {
        Vec3 d = random.direction();
        d.z() = std::abs(d.z()); // half of it only
        exact.push_back(centre + 23.0 * d);
        noisy.push_back(centre + (23.0 + random.real(-0.5, 0.5)) * d);
    }
    const auto a = fit_sphere(exact);
    REQUIRE(a);
    CHECK((a->sphere.centre - centre).norm() < 1e-9);
    CHECK(a->sphere.radius == Approx(23.0));
    CHECK(a->rms < 1e-9);
    const auto b = fit_sphere(noisy);
    REQUIRE(b);
    CHECK((b->sphere.centre - centre).norm() < 0.15);
    CHECK(b->rms == Approx(0.5 / std::sqrt(3.0)).epsilon(0.1));
    // At the minimum the gradient of the sum of squares is zero: sum of residuals and of residual * direction.
    double sum = 0.0;
    Vec3 pull = Vec3::Zero();
    for (const Vec3& p : noisy) {
        const Vec3 d = p - b->sphere.centre;
        sum += d.norm() - b->sphere.radius;
        pull += (d.norm() - b->sphere.radius) * d.normalized();
    }
    CHECK(std::abs(sum) < 1e-7);
    CHECK(pull.norm() < 1e-7);
}

TEST_CASE("weights count, and points of weight zero do not", "[geometry][sphere_fit]") {
    Points points{Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(7, 7, 7)};
    const auto fit = fit_sphere(points, {1, 1, 2, 1, 1, 0});
    REQUIRE(fit);
    CHECK(fit->sphere.centre.norm() < 1e-12);
    CHECK(fit->sphere.radius == Approx(1.0));
}

TEST_CASE("no sphere through a plane, a line, a point, or three points", "[geometry][sphere_fit]") {
    Points plane, line;
    for (int i = 0; i < 30; ++i) {
        plane.emplace_back(i % 6, i / 6, 100.0);
        line.emplace_back(i, 2 * i, 5);
    }
    CHECK_FALSE(fit_sphere(plane));
    CHECK_FALSE(fit_sphere(line));
    CHECK_FALSE(fit_sphere(Points(9, Vec3(1, 2, 3))));
    CHECK_FALSE(fit_sphere({Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}));
    CHECK_FALSE(fit_sphere({}));
}

TEST_CASE("the ball of a joint is found on either bone, in any unit", "[geometry][sphere_fit]") {
    const double scale = GENERATE(1.0, 0.001);
    const Vec3 shift(0.3, -0.2, 0.9);
    const TriMesh ball = moved(ball_on_stick(20.0), scale, shift);
    const TriMesh socket = moved(cup(21.0, 26.0), scale, shift);
    const JointFit moving = fit_joint_centre(ball, {shared(socket)});
    REQUIRE(moving.sphere);
    CHECK((moving.sphere->centre - shift).norm() < 0.02 * scale);
    CHECK(moving.sphere->radius == Approx(20.0 * scale).epsilon(0.005));
    CHECK(moving.coverage > 0.6);
    CHECK(moving.ball_on_moving_bone);
    CHECK(moving.reason.empty());
    const JointFit fixed = fit_joint_centre(socket, {nullptr, shared(ball)});
    REQUIRE(fixed.sphere);
    CHECK((fixed.sphere->centre - shift).norm() < 0.02 * scale);
    CHECK_FALSE(fixed.ball_on_moving_bone);
}

TEST_CASE("bones without a ball give a reason instead", "[geometry][sphere_fit]") {
    const auto check = [](const TriMesh& a, const TriMesh& b) {
        const JointFit fit = fit_joint_centre(a, {shared(b)});
        CHECK_FALSE(fit.sphere);
        CHECK_FALSE(fit.reason.empty());
    };
    check(test::box(4, 4, 1), moved(test::box(4, 4, 1), 1.0, Vec3(0, 0, 2)));
    check(test::torus(), moved(test::torus(), 1.0, Vec3(0, 0, 3)));
    check(TriMesh{}, test::box());
    check(test::box(), TriMesh{});
    CHECK_FALSE(fit_joint_centre(test::box(), {}).sphere);
}
