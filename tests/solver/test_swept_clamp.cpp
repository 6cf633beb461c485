#include "fascicle/geometry/solid_query.hpp"
#include "solver/contact/grid_slope.hpp"
#include "solver/contact/swept_clamp.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>
#include <random>

using namespace fascicle;
using namespace fascicle::solver;

namespace {

const ContactSettings settings{0.1, 0.01, 0.0, 4};

struct Solid {
    TriMesh mesh;
    DistanceGrid grid;
    SolidQuery exact;
    double slope;

    explicit Solid(TriMesh m) : mesh(std::move(m)), grid(mesh, options()), exact(mesh) {
        slope = largest_slope(grid, 1);
    }
    static DistanceGridOptions options() {
        DistanceGridOptions options;
        options.spacing = 0.5;
        options.saturation = 4;
        return options;
    }
    ContactSolid at(const Pose& before, const Pose& now) const { return {&grid, now, before, slope}; }
};

TriMesh moved(TriMesh mesh, const Vec3& by) {
    for (Vec3& p : mesh.positions)
        p += by;
    return mesh;
}

} // namespace

TEST_CASE("free share: nothing on the way that it calls free is nearer than the bound", "[solver][contact]") {
    const Solid torus(test::torus(6, 2, 40, 24));
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-10, 10);
    int stopped = 0;
    for (int i = 0; i < 3000; ++i) {
        const Vec3 a(place(random), place(random), 0.4 * place(random)),
            b(place(random), place(random), 0.4 * place(random));
        if (torus.grid.value(a) < settings.least)
            continue;
        const double share = free_share(torus.grid, a, b, settings.least, settings.offset, torus.slope);
        REQUIRE(share >= 0.0);
        REQUIRE(share <= 1.0);
        double least = 1e300;
        for (int k = 0; k <= 400; ++k)
            least = std::min(least, torus.grid.value(a + share * k / 400.0 * (b - a)));
        CHECK(least >= settings.least - 1e-3); // steps of a thousandth of the spacing at least
        if (share == 1.0)
            continue;
        ++stopped;
        // Where it stops, the solid is at hand.
        CHECK(torus.grid.value(a + share * (b - a)) < settings.least + 0.02);
    }
    CHECK(stopped > 300);
}

TEST_CASE("free share: a way that is far longer than the grid, or not finite, ends", "[solver][contact]") {
    const Solid box(moved(test::box(4, 4, 4), Vec3(-2, -2, -2)));
    const auto share = [&](const Vec3& a, const Vec3& b) {
        return free_share(box.grid, a, b, 0.01, 0.1, box.slope);
    };
    CHECK(share(Vec3(-1e9, 0.1, 0.2), Vec3(1e9, 0.1, 0.2)) == Approx(0.5).margin(1e-6));
    CHECK(share(Vec3(-1e9, 50, 0), Vec3(1e9, 50, 0)) == 1.0);
    CHECK(share(Vec3(0, 0, 0), Vec3(9, 0, 0)) == 0.0); // begins inside
    CHECK(share(Vec3(3, 0, 0), Vec3(3, 0, 0)) == 1.0);
}

TEST_CASE("clamp: a thin plate is not jumped over, and what is left of the motion slides",
          "[solver][contact]") {
    const Solid plate(moved(test::box(20, 20, 0.8), Vec3(-10, -10, -0.4)));
    const ContactSolid solid = plate.at({}, {});
    const Vec3 before(0, 0, 3);
    Vec3 x(2, 1, -30); // to the other side and far beyond
    CHECK(clamp_motion(x, before, {&solid, 1}, settings) == ClampResult::slid);
    CHECK(x.z() > 0.4);
    CHECK(x.z() < 0.4 + 0.3);
    CHECK(x.x() == Approx(2).margin(0.05));
    CHECK(x.y() == Approx(1).margin(0.05));
    Vec3 clear(1, 1, 2);
    CHECK(clamp_motion(clear, before, {&solid, 1}, settings) == ClampResult::clear);
    CHECK(clear == Vec3(1, 1, 2));
}

TEST_CASE("clamp: whatever is asked for, nobody ends inside, by the exact sides of the surfaces",
          "[solver][contact]") {
    const Solid ball(test::sphere(5, 4)), box(moved(test::box(6, 8, 10), Vec3(4, -4, -5)));
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(-14, 14), turn(-0.5, 0.5), shift(-3, 3);
    int done = 0, held = 0;
    for (int i = 0; i < 4000; ++i) {
        const auto pose = [&] {
            Pose p = rotation_about(Vec3::Zero(), Vec3(turn(random), turn(random), 1), turn(random));
            p.translation += Vec3(shift(random), shift(random), shift(random));
            return p;
        };
        // Apart from each other, or there may be no way between them.
        const Pose away{Mat3::Identity(), Vec3(9, 0, 0)};
        const ContactSolid solids[] = {ball.at(pose(), pose()),
                                       box.at(away.after(pose()), away.after(pose()))};
        const Vec3 before(place(random), place(random), place(random));
        bool outside = true;
        for (const ContactSolid& s : solids)
            outside = outside && s.grid->value(s.before.apply_inverse(before)) >= settings.least;
        if (!outside)
            continue;
        ++done;
        Vec3 x(place(random), place(random), place(random));
        const ClampResult result = clamp_motion(x, before, solids, settings);
        held += result != ClampResult::clear ? 1 : 0;
        REQUIRE(result != ClampResult::impossible);
        CHECK(nearest_solid(x, solids).value >= settings.least);
        CHECK_FALSE(ball.exact.inside(solids[0].now.apply_inverse(x)));
        CHECK_FALSE(box.exact.inside(solids[1].now.apply_inverse(x)));
    }
    CHECK(done > 1000);
    CHECK(held > 100);
}

TEST_CASE("clamp: a solid that sweeps over a point takes it along", "[solver][contact]") {
    const Solid ball(test::sphere(5, 4));
    const Pose before{Mat3::Identity(), Vec3(-6, 0, 0)}, now{Mat3::Identity(), Vec3(6, 0, 0)};
    const ContactSolid solid = ball.at(before, now);
    Vec3 x(0.2, 0.3, 0);
    CHECK(clamp_motion(x, Vec3(0.2, 0.3, 0), {&solid, 1}, settings) != ClampResult::clear);
    CHECK(nearest_solid(x, {&solid, 1}).value >= settings.least);
    CHECK(x.x() > 6.0); // before it, not behind it
}

TEST_CASE(
    "clamp: between closing plates a point leaves at the side, and is called impossible where there is none",
    "[solver][contact]") {
    const Solid low(moved(test::box(6, 6, 4), Vec3(-3, -3, -4))),
        high(moved(test::box(6, 6, 4), Vec3(-3, -3, 1)));
    const Pose closed{Mat3::Identity(), Vec3(0, 0, -0.99)};
    ContactSolid solids[] = {low.at({}, {}), high.at({}, closed)};
    Vec3 x(0.5, 0, 0.5);
    CHECK(clamp_motion(x, x, solids, settings) == ClampResult::ejected);
    CHECK(nearest_solid(x, solids).value >= settings.least);
    // Both fill everything within reach.
    const Solid all(moved(test::box(60, 60, 60), Vec3(-30, -30, -61))),
        rest(moved(test::box(60, 60, 60), Vec3(-30, -30, 1)));
    const Pose shut{Mat3::Identity(), Vec3(0, 0, -3)};
    ContactSolid both[] = {all.at({}, {}), rest.at({}, shut)};
    Vec3 y(0, 0, 0);
    CHECK(clamp_motion(y, y, both, settings) == ClampResult::impossible);
    CHECK(y.allFinite());
}
