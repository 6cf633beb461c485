#include "fascicle/anatomy/geodesic_path.hpp"
#include "fascicle/anatomy/line_path.hpp"
#include "fascicle/anatomy/wrap_surface.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/geometry/primitives.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>
#include <numbers>

using namespace fascicle;

namespace {

double wrapped_length(const WrapSurface& surface, const Vec3& p, const Vec3& q) {
    const WrapContact c = wrap_segment(surface, p, q, nullptr);
    REQUIRE(c.wraps());
    return (c.first - p).norm() + c.surface_length + (q - c.second).norm();
}

/// The string as it is said to be: outside at finely sampled points, by the exact distance, and as long as its points say.
void check_outside(const GeodesicPath& path, std::span<const PlacedObstacle> obstacles) {
    CHECK(path.clear);
    CHECK(path.touching.size() == path.points.size());
    double length = 0;
    for (std::size_t i = 0; i + 1 < path.points.size(); ++i) {
        length += (path.points[i + 1] - path.points[i]).norm();
        const bool way_out =
            (i == 0 && path.start_depth > 0) || (i + 2 == path.points.size() && path.end_depth > 0);
        for (int k = 0; k <= 20 && !way_out; ++k) {
            const Vec3 x = path.points[i] + k / 20.0 * (path.points[i + 1] - path.points[i]);
            for (const PlacedObstacle& obstacle : obstacles)
                CHECK(obstacle.bone->distance(obstacle.pose.apply_inverse(x)) > 0);
        }
    }
    CHECK(path.length == Approx(length));
}

} // namespace

TEST_CASE("geodesic string: round a sphere of triangles as long as round a sphere", "[anatomy][geodesic]") {
    const double r = 0.05;
    const BoneObstacle bone(test::sphere(r, 5));
    const Pose pose{rotation_xyz(Vec3(0.3, 0.2, 0.1)), Vec3(1, 2, 3)};
    const PlacedObstacle placed[] = {{&bone, pose}};
    WrapSurface sphere;
    sphere.radius = r;
    for (const Vec3& end : {Vec3(-0.1, 0.01, 0.02), Vec3(-0.07, 0.03, -0.02)}) {
        const Vec3 p(0.12, 0.0, 0.01);
        const GeodesicPath path = geodesic_path(pose.apply(p), pose.apply(end), placed);
        check_outside(path, placed);
        CHECK(path.points.size() > 10);
        const double exact = wrapped_length(sphere, p, end);
        CHECK(path.length == Approx(exact).epsilon(1e-3));
        CHECK(path.length > (end - p).norm());
        // It stays in the plane through the ends and the centre, but for what triangles do.
        const Vec3 normal = p.cross(end).normalized();
        for (const Vec3& x : path.points)
            CHECK(std::abs(pose.apply_inverse(x).dot(normal)) < 0.02 * r);
    }
}

TEST_CASE("geodesic string: finer strings on finer meshes come nearer to the closed form",
          "[anatomy][geodesic]") {
    const Vec3 p(2, 0, 0.1), q(-1.5, 0.4, -0.2);
    WrapSurface sphere;
    sphere.radius = 1;
    const double exact = wrapped_length(sphere, p, q);
    double last = 1;
    for (const int level : {2, 3, 4, 5}) {
        const BoneObstacle bone(test::sphere(1, level));
        const PlacedObstacle placed[] = {{&bone, {}}};
        const GeodesicPath path = geodesic_path(p, q, placed, {10 << (level - 2), 1e-5});
        check_outside(path, placed);
        const double error = std::abs(path.length / exact - 1);
        CHECK(error < 0.5 * last);
        last = error;
    }
    CHECK(last < 1e-3);
}

TEST_CASE("geodesic string: across and along a cylinder of triangles", "[anatomy][geodesic]") {
    const double r = 0.03;
    const BoneObstacle bone(cylinder_mesh(Vec3(0, 0, -0.5), Vec3(0, 0, 0.5), r, 128, 20));
    const PlacedObstacle placed[] = {{&bone, {}}};
    WrapSurface cylinder;
    cylinder.shape = WrapShape::cylinder;
    cylinder.radius = r;
    cylinder.length = 1;
    for (const double rise : {0.0, 0.08, 0.3}) {
        const Vec3 p(0.08, 0.01, -rise / 2), q(-0.06, 0.005, rise / 2);
        const GeodesicPath path = geodesic_path(p, q, placed);
        check_outside(path, placed);
        CHECK(path.length == Approx(wrapped_length(cylinder, p, q)).epsilon(1e-3));
    }
}

TEST_CASE("geodesic string: nothing in the way is a straight line", "[anatomy][geodesic]") {
    const BoneObstacle bone(test::sphere(1, 3));
    const PlacedObstacle placed[] = {{&bone, {}}};
    const Vec3 p(2, 1.5, 0), q(-2, 1.5, 0);
    const GeodesicPath path = geodesic_path(p, q, placed);
    CHECK(path.length == Approx(4).epsilon(1e-12));
    CHECK(path.points.size() == 2);
    CHECK(path.clear);
    for (const int touching : path.touching)
        CHECK(touching == -1);
    CHECK(geodesic_path(p, q, {}).length == Approx(4).epsilon(1e-12));
    CHECK(geodesic_path(p, p, {}).length == 0);
}

TEST_CASE("geodesic string: over the edge of a box, by unfolding", "[anatomy][geodesic]") {
    TriMesh box = test::box(2, 2, 2);
    for (Vec3& x : box.positions)
        x -= Vec3(1, 1, 1);
    const BoneObstacle bone(box);
    const PlacedObstacle placed[] = {{&bone, {}}};
    // From above the top to beside the side, over the edge x = z = 1: the shortest way touches the edge once.
    const Vec3 p(0, -0.3, 1.2), q(1.3, 0.5, -0.4);
    const GeodesicPath path = geodesic_path(p, q, placed, {80, 1e-4});
    check_outside(path, placed);
    // Over a straight edge both parts make one angle with it: unfolded about the edge they are a straight line.
    const double before = std::hypot(1, 0.2), after = std::hypot(0.3, 1.4);
    CHECK(path.length == Approx(std::hypot(before + after, 0.8)).epsilon(4e-3));
}

TEST_CASE("geodesic string: ends inside of a bone are led out, and told", "[anatomy][geodesic]") {
    const BoneObstacle bone(test::sphere(1, 4));
    const PlacedObstacle placed[] = {{&bone, {}}};
    const Vec3 p(0, 0.98, 0), q(-0.3, -1.5, 0.2);
    const GeodesicPath path = geodesic_path(p, q, placed, {40, 1e-3});
    CHECK(path.start_depth == Approx(0.021).margin(2e-3));
    CHECK(path.end_depth == 0);
    CHECK(path.points.size() > 10);
    CHECK(path.points.front() == p);
    CHECK(path.touching.front() == 0);
    check_outside(path, placed);
}

TEST_CASE("geodesic string: over two bones, and what it takes part in when one turns",
          "[anatomy][geodesic]") {
    // A pulley on the hinge's axis and a roller on the arm: the arm is that of the tight string, by differences, too.
    const BoneObstacle pulley(cylinder_mesh(Vec3(0, 0, -0.2), Vec3(0, 0, 0.2), 0.04, 256, 4));
    const BoneObstacle roller(cylinder_mesh(Vec3(-0.15, 0.02, -0.2), Vec3(-0.15, 0.02, 0.2), 0.02, 256, 4));
    const Vec3 origin(0.2, 0, 0), insertion(-0.25, 0, 0);
    const auto solve = [&](double angle) {
        const Pose arm = rotation_about(Vec3::Zero(), Vec3::UnitZ(), angle);
        const PlacedObstacle placed[] = {{&pulley, {}}, {&roller, arm}};
        Points start;
        for (int i = 0; i <= 80; ++i) // above the pulley: on the side that is meant
            start.push_back(origin + i / 80.0 * (arm.apply(insertion) - origin) +
                            Vec3(0, 0.06 * std::sin(i * std::numbers::pi / 80), 0));
        GeodesicPath path = geodesic_path(origin, arm.apply(insertion), placed, {80, 2e-5}, start);
        CHECK(path.clear);
        return path;
    };
    const double angle = 0.3, h = 0.02;
    const GeodesicPath path = solve(angle);
    std::vector<int> bodies;
    for (const int touching : path.touching)
        bodies.push_back(touching == 1 ? 1 : 0);
    bodies.back() = 1;
    CHECK(std::count(path.touching.begin(), path.touching.end(), 0) > 3);
    CHECK(std::count(path.touching.begin(), path.touching.end(), 1) > 1);
    const std::vector<Twist> twists{{}, {Vec3::UnitZ(), Vec3::Zero()}};
    const double arm = polyline_moment_arm(path.points, bodies, twists);
    CHECK(arm == Approx(-0.04).epsilon(0.01)); // the radius of the pulley
    CHECK(arm == Approx(-(solve(angle + h).length - solve(angle - h).length) / (2 * h)).epsilon(0.01));
}

TEST_CASE("geodesic string: same bits every time, bad input told", "[anatomy][geodesic]") {
    const BoneObstacle bone(test::sphere(1, 3));
    const PlacedObstacle placed[] = {{&bone, {}}};
    const Vec3 p(2, 0, 0.1), q(-1.5, 0.4, -0.2);
    const GeodesicPath a = geodesic_path(p, q, placed), b = geodesic_path(p, q, placed);
    CHECK(a.points == b.points);
    CHECK_THROWS_AS(geodesic_path(p, q, placed, {1, 1e-3}), Error);
    CHECK_THROWS_AS(geodesic_path(p, q, placed, {40, 0}), Error);
    CHECK_THROWS_AS(geodesic_path(p, q, placed, {40, std::nan("")}), Error);
    CHECK_THROWS_WITH(geodesic_path(Vec3(std::nan(""), 0, 0), q, placed), Catch::Contains("finite"));
}
