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

TEST_CASE("nothing within the radius is on the other side", "[geometry][solid_query]") {
    TriMesh cup = test::sphere(2.0, 2);
    const bool open = GENERATE(false, true);
    if (open)
        std::erase_if(cup.triangles,
                      [&](const Tri& t) { return cup.positions[static_cast<std::size_t>(t[0])].z() > 0.9; });
    const SolidQuery solid(cup);
    CHECK(solid.closed() == !open);
    test::Random random(5);
    int positive = 0, other_side = 0;
    for (int i = 0; i < 2000; ++i) {
        const Vec3 p = random.in_box(Vec3::Constant(-6), Vec3::Constant(6));
        int hint = -1;
        const SolidSide side = solid.side(p, 100.0, hint);
        CHECK(side.distance == Approx(test::signed_distance(cup, p)));
        CHECK(side.radius <= std::abs(side.distance));
        if (!open)
            CHECK(side.radius == std::abs(side.distance));
        CHECK(solid.side(p, 100.0, hint, side.distance < 0).distance == side.distance);
        positive += side.radius > 0;
        const Vec3 q = p + 0.999 * side.radius * random.direction();
        CHECK((winding_number(cup.positions, cup.triangles, q) > 0.5) == (side.distance < 0));
        other_side += side.distance < 0;
    }
    CHECK(positive > 500);
    CHECK(other_side > 20);
}
