#include "fascicle/geometry/solid_query.hpp"
#include "geometry/surface_oracles.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;

TEST_CASE("signed distance of a box in closed form", "[geometry][solid_query]") {
    const SolidQuery box(test::box(2, 2, 2));
    CHECK(box.signed_distance(Vec3(1, 1, 0.25)) == Approx(-0.25));
    CHECK(box.signed_distance(Vec3(1, 1, -3)) == Approx(3.0));
    CHECK(box.signed_distance(Vec3(5, 6, 1)) == Approx(5.0));
    CHECK(box.signed_distance(Vec3(1, 1, 1), 0.5) == -0.5);
    CHECK(box.signed_distance(Vec3(1, 1, 9), 0.5) == 0.5);
    CHECK(box.inside(Vec3(0.1, 0.1, 0.1)));
    CHECK_FALSE(box.inside(Vec3(-0.1, 0.1, 0.1)));
}

TEST_CASE("signed distance against brute force, with a hole too", "[geometry][solid_query]") {
    TriMesh mesh = test::joined(test::torus(), test::sphere(1.5, 2, Vec3(3, 0, 0.5)));
    if (GENERATE(false, true))
        mesh.triangles.erase(mesh.triangles.begin() + 40, mesh.triangles.begin() + 44);
    const SolidQuery solid(mesh);
    test::Random random(21);
    int hint = -1;
    for (int i = 0; i < 500; ++i) {
        const Vec3 p = random.in_box(Vec3(-5, -5, -2), Vec3(5, 5, 2));
        CHECK(solid.signed_distance(p, 100.0, hint) == Approx(test::signed_distance(mesh, p)).margin(1e-12));
    }
}
