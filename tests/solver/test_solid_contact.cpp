#include "solver/contact/solid_contact.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>
#include <random>

using namespace fascicle;
using namespace fascicle::solver;

namespace {

DistanceGrid grid_of(const TriMesh& mesh) {
    DistanceGridOptions options;
    options.spacing = 0.5;
    options.saturation = 4;
    return DistanceGrid(mesh, options);
}

const ContactSettings settings{0.2, 0.02, 0.0, 8};

} // namespace

TEST_CASE("contact: a point inside a ball comes out to the offset, one outside is left alone",
          "[solver][contact]") {
    const DistanceGrid grid = grid_of(test::sphere(10, 4));
    const ContactSolid solid{&grid, Pose{}, Pose{}};
    Vec3 inside(0, 0, 9.3);
    const ContactResult result = resolve_contact(inside, inside, {&solid, 1}, settings);
    CHECK(result.touched);
    CHECK(result.outside);
    CHECK(grid.value(inside) >= 0.5 * settings.offset);
    CHECK(inside.norm() == Approx(10.2).margin(0.15));
    Vec3 outside(0, 10.5, 0);
    CHECK_FALSE(resolve_contact(outside, outside, {&solid, 1}, settings).touched);
    CHECK(outside == Vec3(0, 10.5, 0));
}

TEST_CASE("contact: happens in the solid's own frame", "[solver][contact]") {
    const DistanceGrid grid = grid_of(test::box(10, 4, 6));
    const Pose pose = rotation_about(Vec3(3, -2, 1), Vec3(1, 2, 2), 0.9);
    const ContactSolid still{&grid, Pose{}, Pose{}}, moved{&grid, pose, pose};
    std::mt19937 random(3);
    std::uniform_real_distribution<double> side(-1, 11);
    int touched = 0;
    for (int i = 0; i < 300; ++i) {
        const Vec3 p(side(random), side(random), side(random));
        Vec3 a = p, b = pose.apply(p);
        touched += resolve_contact(a, p, {&still, 1}, settings).touched ? 1 : 0;
        resolve_contact(b, pose.apply(p), {&moved, 1}, settings);
        CHECK((pose.apply(a) - b).norm() < 1e-9);
    }
    CHECK(touched > 20);
}

TEST_CASE("contact: between two solids the point ends outside of both", "[solver][contact]") {
    const DistanceGrid grid = grid_of(test::box(10, 10, 10));
    // A wedge: two boxes leaning apart; the point has to climb out along the gap.
    const Pose left =
        rotation_about(Vec3::Zero(), Vec3::UnitZ(), 0.15).after({Mat3::Identity(), Vec3(0, 0.3, 0)});
    const Pose right{Mat3::Identity(), Vec3(0, -10, 0)};
    const std::vector<ContactSolid> solids{{&grid, left, left}, {&grid, right, right}};
    Vec3 p(0.3, 0.02, 5); // where the gap is narrower than two offsets
    ContactSettings many = settings;
    many.passes = 200;
    const ContactResult result = resolve_contact(p, p, solids, many);
    CHECK(result.touched);
    for (const ContactSolid& solid : solids)
        CHECK(grid.value(solid.now.apply_inverse(p)) > 0.9 * settings.offset);
    CHECK(p.x() > 0.5);
}

TEST_CASE("contact: friction holds a slow slip and brakes a fast one", "[solver][contact]") {
    const DistanceGrid grid = grid_of(test::box(20, 20, 5));
    const ContactSolid solid{&grid, Pose{}, Pose{}};
    const double friction = GENERATE(0.0, 0.4);
    ContactSettings rough = settings;
    rough.friction = friction;
    rough.passes = 1;
    const Vec3 before(10, 10, 5.2);
    for (const double slip : {0.01, 1.0}) {
        Vec3 x(10 + slip, 10, 5.0); // pressed in by about 0.2
        const double depth = rough.offset - grid.value(x);
        resolve_contact(x, before, {&solid, 1}, rough);
        const double expected = std::max(0.0, slip - friction * depth);
        CHECK(x.x() - 10 == Approx(expected).margin(0.02 * depth));
    }
    // A solid that moves along takes the point with it.
    const ContactSolid moving{&grid, Pose{Mat3::Identity(), Vec3(0.02, 0, 0)}, Pose{}};
    Vec3 x(10, 10, 5.0);
    resolve_contact(x, before, {&moving, 1}, rough);
    CHECK(x.x() - 10 == Approx(friction > 0 ? 0.02 : 0.0).margin(1e-3));
}

TEST_CASE("contact: deep inside, where the grid has no direction, is reported and finite",
          "[solver][contact]") {
    const DistanceGrid grid = grid_of(test::sphere(10, 4));
    const ContactSolid solid{&grid, Pose{}, Pose{}};
    Vec3 centre(0, 0, 0);
    CHECK_FALSE(resolve_contact(centre, centre, {&solid, 1}, settings).outside);
    CHECK(centre.allFinite());
}
