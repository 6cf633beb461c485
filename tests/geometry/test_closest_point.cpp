#include "geometry/surface_oracles.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;

namespace {

/// Smallest distance to a fine lattice of points of the triangle: never below the true one.
double lattice_distance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c, int n) {
    double best = 1e300;
    for (int i = 0; i <= n; ++i)
        for (int j = 0; i + j <= n; ++j)
            best = std::min(best, (p - (a + (b - a) * i / n + (c - a) * j / n)).norm());
    return best;
}

} // namespace

TEST_CASE("closest point of a right triangle, region by region", "[geometry][closest_point]") {
    const Vec3 a(0, 0, 0), b(2, 0, 0), c(0, 2, 0);
    const auto foot = [&](const Vec3& p) { return closest_point_on_triangle(p, a, b, c).point; };
    CHECK(foot(Vec3(0.5, 0.5, 3)) == Vec3(0.5, 0.5, 0));
    CHECK(foot(Vec3(-1, -1, 1)) == a);
    CHECK(foot(Vec3(5, -1, 1)) == b);
    CHECK(foot(Vec3(-1, 4, 0)) == c);
    CHECK(foot(Vec3(0.5, -1, 2)) == Vec3(0.5, 0, 0));
    CHECK(foot(Vec3(-1, 1.5, 2)) == Vec3(0, 1.5, 0));
    CHECK((foot(Vec3(2, 2, 1)) - Vec3(1, 1, 0)).norm() < 1e-15);
    // Two edges in sight, the nearer one counts.
    CHECK(foot(Vec3(3, -0.1, 0)) == b);
}

TEST_CASE("closest point of random triangles against a fine lattice", "[geometry][closest_point]") {
    test::Random random(7);
    const Vec3 low = Vec3::Constant(-1), high = Vec3::Constant(1);
    for (int i = 0; i < 300; ++i) {
        const Vec3 a = random.in_box(low, high), b = random.in_box(low, high);
        Vec3 c = random.in_box(low, high);
        if (i % 3 == 0) // obtuse slivers
            c = a + 0.3 * (b - a) + 0.02 * (c - a);
        const Vec3 p = 2.0 * random.in_box(low, high);
        const TrianglePoint q = closest_point_on_triangle(p, a, b, c);
        CHECK(q.weights.minCoeff() >= 0.0);
        CHECK(q.weights.sum() == Approx(1.0));
        CHECK((q.weights[0] * a + q.weights[1] * b + q.weights[2] * c - q.point).norm() < 1e-12);
        CHECK((p - q.point).squaredNorm() == Approx(q.squared_distance).margin(1e-15));
        const double lattice = lattice_distance(p, a, b, c, 60);
        CHECK(std::sqrt(q.squared_distance) <= lattice + 1e-12);
        CHECK(std::sqrt(q.squared_distance) >= lattice - 0.06);
    }
}

TEST_CASE("triangles without area are segments or points", "[geometry][closest_point]") {
    const Vec3 a(1, 1, 1), b(3, 1, 1);
    for (const Vec3& c : {a, b, Vec3(2, 1, 1), Vec3(7.0 / 3.0, 1, 1)}) {
        CHECK(closest_point_on_triangle(Vec3(1.5, 4, 1), a, b, c).squared_distance == Approx(9.0));
        CHECK(closest_point_on_triangle(Vec3(0, 1, 1), c, a, b).squared_distance == Approx(1.0));
        CHECK(closest_point_on_triangle(Vec3(4, 1, 2), b, c, a).squared_distance == Approx(2.0));
    }
    const TrianglePoint q = closest_point_on_triangle(Vec3(1, 3, 1), a, a, a);
    CHECK(q.squared_distance == 4.0);
    CHECK(q.point == a);
    CHECK(closest_share_on_segment(Vec3(9, 9, 9), a, a) == 0.0);
    CHECK(closest_share_on_segment(Vec3(2.5, 9, 9), a, b) == Approx(0.75));
}
