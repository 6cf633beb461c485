#include "anatomy/fibres/template_fit.hpp"
#include "fascicle/anatomy/fibre_template.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <set>

using namespace fascicle;

namespace {

FibreTemplate with_polygons(std::vector<FibrePolygon> front, std::vector<FibrePolygon> back = {}) {
    return {"test", "Test", "", std::move(front), std::move(back)};
}

} // namespace

TEST_CASE("fibre template: parallel fibres are straight lines at equal steps", "[anatomy][fibres]") {
    for (const double r : {0.0, 0.4, 1.0})
        for (const double s : {0.0, 0.3, 1.0})
            for (const double t : {0.0, 0.7, 1.0})
                CHECK((parallel_template().point(r, s, t) - Vec3(s, t, r)).norm() < 1e-14);
}

TEST_CASE("fibre template: a rational quadratic of weight root a half is a circle's arc",
          "[anatomy][fibres]") {
    const double w = std::sqrt(0.5);
    const std::vector<Vec2> arc{{1, 0}, {1, 1}, {0, 1}};
    const FibreTemplate circle = with_polygons({{0, arc, w}, {1, arc, w}});
    for (int k = 0; k <= 20; ++k) {
        const Vec3 p = circle.point(0.3, 0.6, k / 20.0);
        CHECK(p.head<2>().norm() == Approx(1.0));
        CHECK(p.z() == 0.3);
    }
    CHECK((circle.point(0, 0, 0.5).head<2>() - Vec2(w, w)).norm() < 1e-14);
}

TEST_CASE("fibre template: a cubic with weights agrees with its closed form", "[anatomy][fibres]") {
    const std::vector<Vec2> polygon{{0, 0}, {1, 0.1}, {0.9, 1}, {0, 1}};
    const FibreTemplate cubic = with_polygons({{0, polygon, 20}, {1, polygon, 20}});
    for (const double t : {0.1, 0.35, 0.5, 0.8}) {
        const double u = 1 - t;
        const std::array<double, 4> basis{u * u * u, 20 * 3 * u * u * t, 20 * 3 * u * t * t, t * t * t};
        Vec2 sum = Vec2::Zero();
        double weights = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            sum += basis[i] * polygon[i];
            weights += basis[i];
        }
        CHECK((cubic.point(0, 0.5, t).head<2>() - sum / weights).norm() < 1e-13);
    }
}

TEST_CASE("fibre template: points and weights are blended across and front to back", "[anatomy][fibres]") {
    const FibrePolygon low{0, {{0, 0}, {0, 0.5}, {0, 1}}, 1}, high{1, {{1, 0}, {0.5, 0.5}, {1, 1}}, 3};
    FibrePolygon shifted = low;
    for (Vec2& p : shifted.points)
        p.x() += 0.4;
    const FibreTemplate both = with_polygons({low, high}, {shifted, high});
    // s = 1/2, t = 1/2: inner point (1/4, 1/2) with weight 2, ends x = 1/2; Bernstein 1/4, 1/2, 1/4.
    CHECK(both.point(0, 0.5, 0.5).x() == Approx((0.25 * 0.5 * 2 + 2 * 0.5 * 0.25) / (0.5 + 2 * 0.5)));
    CHECK(both.point(0, 0, 0.3).x() == Approx(0.0).margin(1e-15));
    CHECK(both.point(1, 0, 0.3).x() == Approx(0.4));
    CHECK(both.point(0.5, 0, 0.3).x() == Approx(0.2));
}

TEST_CASE("fibre template: a polygon of a point less has its middle doubled", "[anatomy][fibres]") {
    const FibreTemplate mixed =
        with_polygons({{0, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 1}, {1, {{0, 0}, {0.2, 0.5}, {0, 1}}, 1}});
    // Cubic with both inner points at (0.2, 0.5): x(1/2) = 0.2 * 6/8.
    CHECK(mixed.point(0, 1, 0.5).x() == Approx(0.15));
    CHECK(mixed.point(0, 0, 0.5).x() == Approx(0.75));
}

TEST_CASE("fibre template: faults are named", "[anatomy][fibres]") {
    const std::vector<Vec2> line{{0, 0}, {0, 1}};
    const auto fault = [](const FibreTemplate& one) {
        try {
            check_template(one, "here");
        } catch (const std::exception& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    CHECK(fault(parallel_template()).empty());
    CHECK_THAT(fault(with_polygons({})), Catch::Contains("here: front") && Catch::Contains("0 polygons"));
    CHECK_THAT(fault(with_polygons({{0, line, 1}, {0.5, line, 1}})), Catch::Contains("s is 0.5"));
    CHECK_THAT(fault(with_polygons({{0, line, 1}, {0.5, line, 1}, {0.5, line, 1}, {1, line, 1}})),
               Catch::Contains("front[2]"));
    CHECK_THAT(fault(with_polygons({{0, line, 1}, {1, {{0, 0}}, 1}})), Catch::Contains("1 points"));
    CHECK_THAT(fault(with_polygons({{0, line, 1}, {1, {{0, 0}, {0, 1.5}}, 1}})), Catch::Contains("1.5"));
    CHECK_THAT(fault(with_polygons({{0, line, 1}, {1, {{0, 0}, {0, std::nan("")}}, 1}})),
               Catch::Contains("coordinates"));
    CHECK_THAT(fault(with_polygons({{0, line, 0}, {1, line, 1}})), Catch::Contains("weight is 0"));
    CHECK_THAT(fault(with_polygons({{0, line, 1}, {1, {{0, 1}, {0, 0}}, 1}})),
               Catch::Contains("front[1]") && Catch::Contains("insertion"));
    CHECK_THAT(fault(with_polygons({{0, {{0, 0.5}, {1, 0.5}}, 1}, {1, line, 1}})),
               Catch::Contains("front[0]"));
    CHECK_THAT(fault(with_polygons({{0, line, 1}, {1, {{0, 0}, {0, 0.3}, {0, 0.6}, {0, 1}}, 1}})),
               Catch::Contains("2 and 4 points"));
    CHECK_THAT(fault(with_polygons({{0, line, 1}, {1, line, 1}}, {{0, line, 1}})), Catch::Contains("back"));
}

TEST_CASE("fibre seeds: a square number makes a grid, others spread evenly without repeats",
          "[anatomy][fibres]") {
    const auto grid = fibre_seeds(9);
    CHECK((grid[0] - Vec2(1.0 / 6, 1.0 / 6)).norm() < 1e-15);
    CHECK((grid[8] - Vec2(5.0 / 6, 5.0 / 6)).norm() < 1e-15);
    for (const int count : {1, 2, 7, 50, 1999}) {
        const auto seeds = fibre_seeds(count);
        REQUIRE(static_cast<int>(seeds.size()) == count);
        std::set<std::pair<double, double>> different;
        for (const Vec2& p : seeds) {
            CHECK((p.minCoeff() > 0 && p.maxCoeff() < 1));
            different.insert({p.x(), p.y()});
        }
        CHECK(different.size() == seeds.size());
    }
    // The first 2^k Sobol points put one in each of 2^k strips, both ways, and one in each 4 x 8 cell.
    std::vector<int> columns(32, 0), rows(32, 0), cells(32, 0);
    for (const Vec2& p : fibre_seeds(32)) {
        ++columns[static_cast<std::size_t>(p.x() * 32)];
        ++rows[static_cast<std::size_t>(p.y() * 32)];
        ++cells[static_cast<std::size_t>(static_cast<int>(p.x() * 4) * 8 + static_cast<int>(p.y() * 8))];
    }
    CHECK(columns == std::vector<int>(32, 1));
    CHECK(rows == std::vector<int>(32, 1));
    CHECK(cells == std::vector<int>(32, 1));
}

TEST_CASE("fibres in the cube run from end to end in equal steps", "[anatomy][fibres]") {
    const FibreTemplate oblique = with_polygons({{0, {{0, 0.5}, {1, 1}}, 1}, {1, {{0, 0}, {1, 0.5}}, 1}});
    const Points line = fibre_in_cube(oblique, 0.25, 0.5, 40);
    REQUIRE(line.size() == 41);
    CHECK((line.front() - Vec3(0, 0, 0.25)).norm() < 1e-12);
    CHECK((line.back() - Vec3(1, 1, 0.25)).norm() < 1e-12);
    double length = 0;
    for (std::size_t i = 1; i < line.size(); ++i) {
        CHECK(line[i].y() >= line[i - 1].y() - 1e-12);
        length += (line[i] - line[i - 1]).norm();
    }
    // 1/4 along the face, the fibre, 1/4 along the other face; steps cut the two corners.
    CHECK(length == Approx(0.5 + std::hypot(1.0, 0.5)).epsilon(0.01));
    const Points straight = fibre_in_cube(parallel_template(), 0.1, 0.9, 10);
    for (std::size_t j = 0; j <= 10; ++j)
        CHECK((straight[j] - Vec3(0.9, double(j) / 10, 0.1)).norm() < 1e-12);
}
