#include "fascicle/anatomy/fibre_architecture.hpp"

#include "fascicle/base/error.hpp"
#include "support/fibres.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

using namespace fascicle;
using namespace fascicle::test;
using Catch::Matchers::Contains;

namespace {

constexpr double degree = std::numbers::pi / 180.0;

/// A tendon along z that fibres reach from both sides at `alpha`, or from +x alone; n on a side, 4 apart, fibres as
/// far from the tendon as `width` at their origin.
FibreSet pennate(double alpha, int n, double width, bool both_sides) {
    std::vector<std::pair<Vec3, Vec3>> ends;
    for (int i = 0; i < n; ++i)
        for (const double side : {1.0, -1.0})
            if (side > 0.0 || both_sides)
                ends.emplace_back(Vec3(side * width, 0, 4.0 * i - width / std::tan(alpha)),
                                  Vec3(0, 0, 4.0 * i));
    return straight_fibres(ends, 10);
}

/// n x n fibres of length l along x.
FibreSet lattice(int n, double spacing, double l, bool triangular) {
    std::vector<std::pair<Vec3, Vec3>> ends;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const Vec3 p(0, spacing * (i + (triangular && j % 2 == 1 ? 0.5 : 0.0)),
                         spacing * j * (triangular ? std::sqrt(0.75) : 1.0));
            ends.emplace_back(p, p + Vec3(l, 0, 0));
        }
    return straight_fibres(ends, 9);
}

FibreSet random_fibres(int count, int segments, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    FibreSet fibres{count, segments, {}};
    for (int f = 0; f < count; ++f) {
        Vec3 p(5 * number(random), 5 * number(random), 5 * number(random));
        for (int j = 0; j <= segments; ++j, p += Vec3(number(random), number(random), 1.0))
            fibres.points.push_back(p);
    }
    return fibres;
}

/// Distance of p to a segment by golden section: another way than that of the program.
double sampled_distance(const Vec3& p, const Vec3& a, const Vec3& b) {
    double low = 0.0, high = 1.0;
    const auto at = [&](double s) { return (a + s * (b - a) - p).norm(); };
    for (int i = 0; i < 80; ++i) {
        const double third = (high - low) / 3.0;
        at(low + third) < at(high - third) ? high -= third : low += third;
    }
    return at(0.5 * (low + high));
}

} // namespace

TEST_CASE("the tangent of an end is the mean over its share of the length", "[anatomy][fibre]") {
    // Length 10: 1 along y, then 9 along x.
    const FibreSet bent = one_fibre({Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(4, 1, 0), Vec3(9, 1, 0)});
    CHECK((end_tangents(bent, FibreEnd::origin, 0.2)[0] - Vec3(1, 1, 0).normalized()).norm() < 1e-14);
    CHECK((end_tangents(bent, FibreEnd::origin, 0.05)[0] - Vec3(0, 1, 0)).norm() < 1e-14);
    CHECK((end_tangents(bent, FibreEnd::insertion, 0.2)[0] - Vec3(1, 0, 0)).norm() < 1e-14);
    CHECK((end_tangents(bent, FibreEnd::insertion, 1.0)[0] - Vec3(9, 1, 0).normalized()).norm() < 1e-14);
    CHECK(end_tangents(one_fibre({Vec3(1, 2, 3), Vec3(1, 2, 3)}), FibreEnd::origin, 0.2)[0] == Vec3::Zero());
    // Out and back within the share: no direction, not a random one.
    CHECK(end_tangents(one_fibre({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 0, 0)}), FibreEnd::origin, 1.0)[0] ==
          Vec3::Zero());
}

TEST_CASE("pennation of a bipennate muscle is the angle it was built with", "[anatomy][fibre]") {
    for (const double alpha : {5 * degree, 20 * degree, 40 * degree}) {
        const Pennation p = fibre_pennation(pennate(alpha, 12, 20.0, true));
        CHECK(p.insertion_line.along_ends); // the insertions lie on the tendon
        CHECK(p.insertion_line.axis_r2 == Approx(1.0));
        CHECK((p.insertion_line.direction - Vec3(0, 0, 1)).norm() < 1e-9);
        CHECK((p.insertion_line.point - Vec3(0, 0, 22)).norm() < 1e-9);
        CHECK_FALSE(p.origin_line.along_ends); // the origins lie on two lines
        CHECK((p.origin_line.direction - Vec3(0, 0, 1)).norm() < 1e-9);
        REQUIRE(p.origin_rad.size() == 24);
        for (std::size_t f = 0; f < 24; ++f) {
            CHECK(p.origin_rad[f] == Approx(alpha).epsilon(1e-9));
            CHECK(p.insertion_rad[f] == Approx(alpha).epsilon(1e-9));
        }
        CHECK(mean_pennation_rad(p) == Approx(alpha));
    }
}

TEST_CASE("pennation of a unipennate muscle shows only through its ends", "[anatomy][fibre]") {
    const FibreSet fibres = pennate(25 * degree, 10, 15.0, false);
    const Pennation p = fibre_pennation(fibres);
    CHECK(p.origin_line.along_ends);
    CHECK(p.insertion_line.along_ends);
    CHECK(p.origin_rad[3] == Approx(25 * degree));
    // All fibres are parallel, so the mean tangent would say 0.
    PennationOptions never;
    never.axis_r2 = 1.5;
    CHECK(fibre_pennation(fibres, never).origin_rad[3] == Approx(0.0).margin(1e-9));
}

TEST_CASE("a strap has no pennation though its ends lie on a line", "[anatomy][fibre]") {
    std::vector<std::pair<Vec3, Vec3>> ends;
    for (int i = 0; i < 20; ++i)
        ends.emplace_back(Vec3(2.0 * i, 0, 0), Vec3(2.0 * i, 0, 30));
    const Pennation p = fibre_pennation(straight_fibres(ends, 5));
    CHECK(p.origin_line.axis_r2 == Approx(1.0));
    CHECK_FALSE(p.origin_line.along_ends); // that line runs across the fibres
    CHECK(mean_pennation_rad(p) == Approx(0.0).margin(1e-12));
}

TEST_CASE("pennation does not depend on place, turn or size", "[anatomy][fibre]") {
    const FibreSet fibres = random_fibres(30, 6, 7);
    FibreSet moved = fibres;
    const Mat3 turn = Eigen::AngleAxisd(1.1, Vec3(1, -2, 3).normalized()).toRotationMatrix();
    for (Vec3& p : moved.points)
        p = 1000.0 * (turn * p) + Vec3(400, -300, 1e5);
    const Pennation a = fibre_pennation(fibres), b = fibre_pennation(moved);
    for (std::size_t f = 0; f < 30; ++f) {
        CHECK(a.origin_rad[f] == Approx(b.origin_rad[f]).margin(1e-8));
        CHECK(a.insertion_rad[f] == Approx(b.insertion_rad[f]).margin(1e-8));
    }
    CHECK(*std::max_element(a.origin_rad.begin(), a.origin_rad.end()) > 10 * degree);
}

TEST_CASE("line of action of few and of odd fibres", "[anatomy][fibre]") {
    // Two ends are always on a line.
    const FibreSet two = straight_fibres({{Vec3(0, 0, 0), Vec3(0, 1, 10)}, {Vec3(0, 0, 5), Vec3(0, 1, 15)}});
    CHECK_FALSE(line_of_action(two, FibreEnd::origin).along_ends);
    const LineOfAction one = line_of_action(one_fibre({Vec3(1, 1, 1), Vec3(1, 1, 4)}), FibreEnd::insertion);
    CHECK(one.direction == Vec3(0, 0, 1));
    CHECK(one.point == Vec3(1, 1, 4));
    CHECK(std::isnan(one.axis_r2));
    const LineOfAction none = line_of_action(FibreSet{}, FibreEnd::origin);
    CHECK(none.direction == Vec3::Zero());
    const Pennation dot = fibre_pennation(one_fibre({Vec3(1, 1, 1), Vec3(1, 1, 1)}));
    CHECK(std::isnan(dot.origin_rad[0]));
    CHECK(std::isnan(mean_pennation_rad(dot)));
    const LineOfAction line = muscle_line(two);
    CHECK(line.point == Vec3(0, 0, 2.5));
    CHECK((line.direction - Vec3(0, 1, 10).normalized()).norm() < 1e-14);
}

TEST_CASE("PCSA in cm2 whatever the scene unit", "[anatomy][fibre]") {
    // 100 cm3 of fibres 10 cm long.
    CHECK(pcsa_cm2(1e5, 0.0, 100.0, 1.0) == Approx(10.0));
    CHECK(pcsa_cm2(1e-4, 0.0, 0.1, 1000.0) == Approx(10.0));
    CHECK(pcsa_cm2(1e5, 60 * degree, 100.0, 1.0) == Approx(5.0));
    CHECK(std::isnan(pcsa_cm2(1e5, 0.0, 0.0, 1.0)));
    CHECK(std::isnan(pcsa_cm2(1e5, std::numeric_limits<double>::quiet_NaN(), 100.0, 1.0)));
}

TEST_CASE("cover of parallel fibres on lattices", "[anatomy][fibre]") {
    const double pi = std::numbers::pi;
    const FibreSet square = lattice(8, 2.5, 40.0, false);
    for (const double r : fibre_radii(square))
        CHECK(r == Approx(1.25));
    CHECK(fibre_cover_percent(square, 64 * 2.5 * 2.5 * 40.0) == Approx(100.0 * pi / 4.0));
    const FibreSet triangular = lattice(8, 2.5, 40.0, true);
    CHECK(fibre_cover_percent(triangular, 64 * std::sqrt(0.75) * 2.5 * 2.5 * 40.0) ==
          Approx(100.0 * pi / std::sqrt(12.0)));
    CHECK(std::isnan(fibre_cover_percent(square, 0.0)));
    CHECK(std::isnan(fibre_radii(one_fibre({Vec3(0, 0, 0), Vec3(1, 0, 0)}))[0]));
    CHECK(std::isnan(fibre_cover_percent(one_fibre({Vec3(0, 0, 0), Vec3(1, 0, 0)}), 1.0)));
    CHECK(fibre_radii(FibreSet{}).empty());
    const FibreSet twins = straight_fibres({{Vec3(0, 0, 0), Vec3(1, 0, 0)}, {Vec3(0, 0, 0), Vec3(1, 0, 0)}});
    CHECK(fibre_radii(twins) == std::vector<double>{0, 0});
}

TEST_CASE("radii are half the mean distance to the nearest other fibre", "[anatomy][fibre]") {
    for (const int segments : {1, 3, 4, 9}) {
        const FibreSet fibres = random_fibres(25, segments, 11);
        const std::vector<double> radii = fibre_radii(fibres);
        CHECK(fibre_radii(fibres, 2) == radii);
        for (int f = 0; f < fibres.count; ++f) {
            double sum = 0.0;
            for (const Vec3& p : fibres.fibre(f)) {
                double best = std::numeric_limits<double>::infinity();
                for (int g = 0; g < fibres.count; ++g)
                    for (std::size_t j = 0; g != f && j < std::size_t(segments); ++j)
                        best =
                            std::min(best, sampled_distance(p, fibres.fibre(g)[j], fibres.fibre(g)[j + 1]));
                sum += best;
            }
            CHECK(radii[std::size_t(f)] == Approx(0.5 * sum / (segments + 1)).epsilon(1e-7));
        }
    }
}

TEST_CASE("a muscle's architecture in one go", "[anatomy][fibre]") {
    FibreSet fibres = lattice(10, 0.002, 0.1, false); // metres: 20 x 20 x 100 mm, 40 cm3
    const MuscleArchitecture a = muscle_architecture(fibres, 4e-5, 1000.0, "strap");
    CHECK(a.length_mean_mm == Approx(100.0));
    CHECK(a.length_min_mm == Approx(100.0));
    CHECK(a.length_max_mm == Approx(100.0));
    CHECK(a.pennation_mean_deg == Approx(0.0).margin(1e-6));
    CHECK(a.pcsa_cm2 == Approx(4.0));
    CHECK(a.cover_percent == Approx(25.0 * std::numbers::pi));
    CHECK((a.line.direction - Vec3(1, 0, 0)).norm() < 1e-14);
    const MuscleArchitecture p =
        muscle_architecture(pennate(30 * degree, 12, 20.0, true), 1e5, 1.0, "pennate");
    CHECK(p.pennation_origin_deg == Approx(30.0));
    CHECK(p.pennation_insertion_deg == Approx(30.0));
    CHECK(p.pcsa_cm2 == Approx(1e5 * std::cos(30 * degree) / 40.0 / 100.0));
    const MuscleArchitecture none = muscle_architecture(FibreSet{}, 1.0, 1.0, "bare");
    CHECK(std::isnan(none.length_mean_mm));
    CHECK(std::isnan(none.length_min_mm));
    CHECK(std::isnan(none.pcsa_cm2));
    fibres.points[3].x() = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH(muscle_architecture(fibres, 1.0, 1.0, "strap"), Contains("strap: point 3 of fibre 0"));
}
