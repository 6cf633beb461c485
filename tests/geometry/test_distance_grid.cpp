#include "fascicle/geometry/distance_grid.hpp"
#include "geometry/surface_oracles.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;

namespace {

DistanceGrid make(const TriMesh& mesh, double spacing, double saturation = 8.0, int threads = 1) {
    DistanceGridOptions options;
    options.spacing = spacing;
    options.saturation = saturation;
    options.threads = threads;
    return {mesh, options};
}

/// Every node (at most about `budget` of them) against brute force: distance exact up to the lowering, sign
/// right.
void check_nodes(const TriMesh& mesh, const DistanceGrid& grid, std::size_t budget) {
    const auto [nx, ny, nz] = grid.nodes();
    const std::size_t count =
        static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny) * static_cast<std::size_t>(nz);
    const std::size_t step = std::max<std::size_t>(1, count / budget);
    int wrong_sign = 0, too_high = 0, too_low = 0, inside = 0;
    for (std::size_t n = 0; n < count; n += step) {
        const int i = static_cast<int>(n) % nx, j = static_cast<int>(n) / nx % ny,
                  k = static_cast<int>(n) / nx / ny;
        const Vec3 p = grid.low() + grid.spacing() * Vec3(i, j, k);
        const double truth =
            std::clamp(test::signed_distance(mesh, p), -grid.saturation(), grid.saturation());
        const double value = grid.node_value(i, j, k);
        inside += truth < -1e-3;
        too_high += value > truth + 2e-4 * grid.spacing();
        too_low += value < truth - grid.correction_max() - 2e-4 * grid.spacing();
        wrong_sign += truth < -1e-3 && value >= 0.0;
    }
    CHECK(wrong_sign == 0);
    CHECK(too_high == 0);
    CHECK(too_low == 0);
    CHECK(inside > 0);
}

void check_conservative(const TriMesh& mesh, const DistanceGrid& grid, int samples = 100000) {
    test::Random random(2);
    double highest = -1e300;
    for (int i = 0; i < samples; ++i)
        highest = std::max(highest, grid.value(random.on_surface(mesh)));
    CHECK(highest <= 0.0);
    for (const Vec3& p : mesh.positions)
        CHECK(grid.value(p) <= 0.0);
}

TriMesh with_own_corners(const TriMesh& mesh) {
    TriMesh soup;
    for (const Tri& t : mesh.triangles) {
        const int first = soup.vertex_count();
        for (const int v : t)
            soup.positions.push_back(mesh.positions[static_cast<std::size_t>(v)]);
        soup.triangles.push_back({first, first + 1, first + 2});
    }
    return soup;
}

} // namespace

TEST_CASE("grid of a sphere: distance, gradient, saturation", "[geometry][distance_grid]") {
    const Vec3 centre(1.3, -2.7, 0.4);
    const TriMesh mesh = test::sphere(10.0, 4, centre);
    const DistanceGrid grid = make(mesh, 0.5, 3.0);
    check_nodes(mesh, grid, 3000);
    check_conservative(mesh, grid);
    CHECK(grid.correction_max() < 0.1);
    CHECK(grid.correction_mean() < 0.02);
    test::Random random(1);
    for (int i = 0; i < 2000; ++i) {
        const Vec3 direction = random.direction();
        const double r = random.real(7.6, 12.4);
        const DistanceSample s = grid.sample(centre + r * direction);
        CHECK(s.value == Approx(r - 10.0).margin(0.12));
        CHECK((s.gradient - direction).norm() < 0.25);
        CHECK(s.value == grid.value(centre + r * direction));
        // Facets lie up to 0.03 below the ball.
        CHECK(s.value < r - 10.0 + 0.05);
    }
    CHECK(grid.value(centre) == -3.0);
    CHECK(grid.sample(centre).gradient == Vec3::Zero());
    CHECK(grid.value(centre + Vec3(13.6, 0, 0)) == 3.0);
    CHECK(grid.value(centre + Vec3(1000, 0, 0)) == 3.0);
    CHECK(grid.sample(centre - Vec3(0, 0, 1e300)).value == 3.0);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(grid.sample(Vec3(nan, 0, 0)).value == 3.0);
    CHECK(grid.sample(Vec3(0, nan, 0)).gradient == Vec3::Zero());
}

TEST_CASE("the gradient is that of the interpolant", "[geometry][distance_grid]") {
    const TriMesh mesh = test::torus(6.0, 2.0);
    const DistanceGrid grid = make(mesh, 0.7, 2.5);
    test::Random random(4);
    const double e = 1e-6;
    for (int i = 0; i < 300; ++i) {
        // The middle part of a cell, so that the difference does not leave it.
        Vec3 p = random.in_box(Vec3(-8, -8, -3), Vec3(8, 8, 3)) - grid.low();
        p = grid.low() + grid.spacing() * ((p / grid.spacing()).array().floor() + 0.5).matrix() +
            0.4 * grid.spacing() * random.in_box(Vec3::Constant(-1), Vec3::Constant(1));
        Vec3 difference;
        for (Eigen::Index k = 0; k < 3; ++k)
            difference[k] =
                (grid.value(p + e * Vec3::Unit(k)) - grid.value(p - e * Vec3::Unit(k))) / (2.0 * e);
        CHECK((grid.sample(p).gradient - difference).norm() < 1e-6);
    }
}

TEST_CASE("grid of a box with faces on nodes and between nodes", "[geometry][distance_grid]") {
    const TriMesh mesh = test::box(10, 6, 4);
    const double spacing = GENERATE(1.0, 0.5, 0.37);
    const DistanceGrid grid = make(mesh, spacing, 2.0);
    check_nodes(mesh, grid, 4000);
    check_conservative(mesh, grid);
    // Beside a face the interpolant of a plane is exact but for the lowering.
    CHECK(grid.value(Vec3(5, 3, 5.5)) == Approx(1.5).margin(1e-6));
    CHECK(grid.value(Vec3(5, 3, 2.5)) == Approx(-1.5).margin(1e-6));
}

TEST_CASE("a plate thinner than the spacing keeps its inside", "[geometry][distance_grid]") {
    // No node need lie inside: the lowering alone must make a barrier of it.
    const TriMesh mesh = test::box(8, 8, 0.2);
    const DistanceGrid grid = make(mesh, 1.0, 3.0);
    check_conservative(mesh, grid);
    CHECK(grid.value(Vec3(4, 4, 2.1)) > 1.0);
    CHECK(grid.value(Vec3(4, 4, -1.9)) > 1.0);
    CHECK(grid.value(Vec3(4, 4, 0.1)) <= 0.0);
    check_nodes(mesh, make(mesh, 0.09, 1.0), 3000);
}

TEST_CASE("signs of nested, touching and overlapping parts", "[geometry][distance_grid]") {
    SECTION("a hollow ball") {
        const TriMesh mesh = test::joined(test::sphere(5.0, 3), test::inside_out(test::sphere(3.0, 3)));
        const DistanceGrid grid = make(mesh, 0.5, 1.5);
        check_nodes(mesh, grid, 3000);
        CHECK(grid.value(Vec3::Zero()) == 1.5);
        CHECK(grid.value(Vec3(4, 0, 0)) < -0.5);
    }
    SECTION("overlapping balls: winding number 2 inside both") {
        const TriMesh mesh = test::joined(test::sphere(5.0, 3), test::sphere(4.0, 3, Vec3(4, 0, 0)));
        const DistanceGrid grid = make(mesh, 0.5, 1.5);
        check_nodes(mesh, grid, 3000);
        check_conservative(mesh, grid);
        CHECK(grid.value(Vec3(2.4, 0, 0)) < 0.0);
    }
    SECTION("inside out: nowhere inside") {
        const DistanceGrid grid = make(test::inside_out(test::sphere(5.0, 2)), 0.5, 1.5);
        CHECK(grid.value(Vec3::Zero()) == 1.5);
    }
    SECTION("a tetrahedron") {
        const TriMesh mesh = test::tetrahedron(5.0);
        const DistanceGrid grid = make(mesh, 0.4, 1.0);
        check_nodes(mesh, grid, 4000);
        check_conservative(mesh, grid);
    }
}

TEST_CASE("signs with doubled vertices, holes and non-manifold edges", "[geometry][distance_grid]") {
    SECTION("every triangle with its own corners") {
        const TriMesh mesh = with_own_corners(test::torus(4.0, 1.5));
        check_nodes(mesh, make(mesh, 0.5, 1.5), 3000);
    }
    SECTION("corners apart by rounding: cracks everywhere") {
        TriMesh mesh = with_own_corners(test::sphere(4.0, 2));
        test::Random random(6);
        for (Vec3& p : mesh.positions)
            p += 1e-9 * random.direction();
        check_nodes(mesh, make(mesh, 0.5, 1.5), 1500);
    }
    SECTION("one triangle missing") {
        TriMesh mesh = test::sphere(4.0, 2);
        mesh.triangles.erase(mesh.triangles.begin() + 17);
        check_nodes(mesh, make(mesh, 0.5, 1.5), 3000);
        check_conservative(mesh, make(mesh, 0.5, 1.5));
    }
    SECTION("cut off at the top") {
        TriMesh mesh = test::sphere(4.0, 3);
        std::erase_if(mesh.triangles,
                      [&](const Tri& t) { return mesh.positions[static_cast<std::size_t>(t[0])].z() > 2.0; });
        check_nodes(mesh, make(mesh, 0.4, 1.5), 3000);
    }
    SECTION("a doubled patch and a loose fin") {
        TriMesh mesh = test::sphere(4.0, 3);
        for (int i = 0; i < 20; ++i)
            mesh.triangles.push_back(mesh.triangles[static_cast<std::size_t>(i)]);
        mesh.positions.emplace_back(7, 7, 7);
        mesh.triangles.push_back({0, 2, mesh.vertex_count() - 1});
        check_nodes(mesh, make(mesh, 0.5, 1.5), 3000);
    }
}

TEST_CASE("the same grid for every number of threads", "[geometry][distance_grid]") {
    TriMesh mesh = test::torus(6.0, 2.0, 48, 24);
    mesh.triangles.pop_back(); // the open path as well
    const DistanceGrid one = make(mesh, 0.4, 3.0, 1);
    for (const int threads : {2, 3}) {
        const DistanceGrid more = make(mesh, 0.4, 3.0, threads);
        REQUIRE(more.nodes() == one.nodes());
        CHECK(more.correction_mean() == one.correction_mean());
        bool same = true;
        for (int k = 0; k < one.nodes()[2]; ++k)
            for (int j = 0; j < one.nodes()[1]; ++j)
                for (int i = 0; i < one.nodes()[0]; ++i)
                    same = same && one.node_value(i, j, k) == more.node_value(i, j, k);
        CHECK(same);
    }
}

TEST_CASE("a grid too large is made coarser", "[geometry][distance_grid]") {
    DistanceGridOptions options;
    options.spacing = 1e-9;
    options.saturation = 1.0;
    options.max_nodes = 20000;
    const TriMesh mesh = test::sphere(5.0, 2);
    const DistanceGrid grid(mesh, options);
    CHECK(grid.bytes() <= 20000 * sizeof(float));
    CHECK(grid.bytes() >= 10000 * sizeof(float));
    check_nodes(mesh, grid, 3000);
    check_conservative(mesh, grid);
}

TEST_CASE("a grid of nothing is saturated, unused vertices do not count", "[geometry][distance_grid]") {
    const DistanceGrid nothing = make(TriMesh{}, 1.0, 2.0);
    CHECK(nothing.value(Vec3::Zero()) == 2.0);
    TriMesh mesh = test::box();
    mesh.positions.emplace_back(1e6, 0, 0);
    CHECK(make(mesh, 0.5, 2.0).bytes() < 10000);
}

TEST_CASE("building reports progress and can be cancelled", "[geometry][distance_grid]") {
    JobControl control;
    std::atomic<bool> cancel = false;
    control.cancel = &cancel;
    double last = -1;
    control.report = [&](std::string_view stage, double fraction) {
        CHECK(stage == "distance grid");
        CHECK(fraction >= last);
        last = fraction;
    };
    DistanceGridOptions options;
    options.threads = 2;
    const TriMesh mesh = test::sphere(20.0, 3);
    const DistanceGrid whole(mesh, options, control);
    CHECK(last == 1.0);
    control.report = [&](std::string_view, double fraction) { cancel = fraction > 0.3; };
    CHECK_THROWS_AS(DistanceGrid(mesh, options, control), Cancelled);
}
