#include "fascicle/geometry/bvh.hpp"
#include "geometry/surface_oracles.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;

TEST_CASE("the tree finds what brute force finds", "[geometry][bvh]") {
    TriMesh mesh = test::joined(test::torus(), test::sphere(1.0, 2, Vec3(1, 0, 2)));
    if (GENERATE(false, true)) { // unused vertex, repeated indices, no area
        mesh.positions.emplace_back(100, 100, 100);
        mesh.triangles.push_back({0, 0, 5});
        mesh.triangles.push_back({7, 7, 7});
    }
    const TriangleBvh bvh(mesh);
    REQUIRE(bvh.triangle_count() == mesh.triangle_count());
    test::Random random(3);
    int hint = -1;
    for (int i = 0; i < 500; ++i) {
        const Vec3 p = random.in_box(Vec3::Constant(-6), Vec3::Constant(6));
        const double exact = test::squared_distance(mesh, p);
        const SurfacePoint q = bvh.closest(p);
        REQUIRE(q.triangle >= 0);
        CHECK(q.squared_distance == Approx(exact).epsilon(1e-10));
        CHECK(test::closest_on_triangle(mesh, mesh.triangles[static_cast<std::size_t>(q.triangle)], p)
                  .squared_distance == Approx(exact).epsilon(1e-10));
        CHECK((p - q.point).squaredNorm() == Approx(exact).epsilon(1e-10));
        CHECK(bvh.closest(p, 1e9, static_cast<int>(random.index(mesh.triangles.size()))).squared_distance ==
              Approx(exact).epsilon(1e-10));
        CHECK(bvh.closest_squared_distance(p, 1e9, hint) == Approx(exact).epsilon(1e-10));
        CHECK(hint >= 0);
        const double d = std::sqrt(exact);
        CHECK(bvh.closest(p, 1.001 * d).triangle >= 0);
        CHECK(bvh.closest(p, 0.999 * d).triangle == -1);
        CHECK(bvh.closest(p, 0.999 * d, 3).triangle == -1);
        // Any triangle will do within twice the distance.
        int met = -1;
        const double enough = bvh.closest_squared_distance(p, 1e9, met, 2.0 * d);
        CHECK(enough >= exact * (1.0 - 1e-10));
        CHECK(enough <= 4.0 * exact);
        CHECK(test::closest_on_triangle(mesh, mesh.triangles[static_cast<std::size_t>(met)], p)
                  .squared_distance == Approx(enough).epsilon(1e-10));
    }
}

TEST_CASE("trees of every small size, and of nothing", "[geometry][bvh]") {
    const TriMesh all = test::sphere(1.0, 1);
    test::Random random(5);
    for (std::size_t count = 1; count <= all.triangles.size(); ++count) {
        TriMesh mesh{all.positions, {all.triangles.begin(), all.triangles.begin() + static_cast<int>(count)}};
        const TriangleBvh bvh(mesh);
        for (int i = 0; i < 20; ++i) {
            const Vec3 p = random.in_box(Vec3::Constant(-2), Vec3::Constant(2));
            CHECK(bvh.closest(p).squared_distance == Approx(test::squared_distance(mesh, p)).epsilon(1e-10));
        }
    }
    CHECK(TriangleBvh(TriMesh{}).closest(Vec3::Zero()).triangle == -1);
    CHECK(TriangleBvh().closest(Vec3::Zero()).triangle == -1);
}

TEST_CASE("many triangles in one place do not make the tree deep", "[geometry][bvh]") {
    TriMesh mesh = test::tetrahedron();
    for (int i = 0; i < 5000; ++i)
        mesh.triangles.push_back({0, 1, 3});
    CHECK(TriangleBvh(mesh).closest(Vec3(0.25, -1, 0.25)).squared_distance == Approx(1.0));
}

TEST_CASE("a refitted tree equals a new one", "[geometry][bvh]") {
    TriMesh mesh = test::torus();
    TriangleBvh bvh(mesh);
    for (Vec3& p : mesh.positions)
        p = Vec3(p.z() + 0.3 * p.x() * p.x(), p.x(), 2.0 * p.y()) + Vec3(10, 0, 0);
    bvh.refit(mesh.positions);
    test::Random random(9);
    for (int i = 0; i < 200; ++i) {
        const Vec3 p = random.in_box(Vec3(5, -5, -9), Vec3(15, 5, 9));
        CHECK(bvh.closest(p).squared_distance == Approx(test::squared_distance(mesh, p)).epsilon(1e-10));
    }
}

TEST_CASE("a point that is not finite is near nothing", "[geometry][bvh]") {
    const TriangleBvh bvh(test::sphere());
    const double nan = std::numeric_limits<double>::quiet_NaN(),
                 inf = std::numeric_limits<double>::infinity();
    CHECK(bvh.closest(Vec3(nan, 0, 0)).triangle == -1);
    CHECK(bvh.closest(Vec3(0, inf, 0)).triangle == -1);
    CHECK(bvh.closest(Vec3(0, inf, 0), 5.0, 2).triangle == -1);
}
