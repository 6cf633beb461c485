#include "fascicle/anatomy/fibre_shape.hpp"

#include "fascicle/base/error.hpp"
#include "support/fibres.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

using namespace fascicle;
using namespace fascicle::test;
using Catch::Matchers::Contains;

namespace {

/// Points on a circle of radius r about z at these angles.
FibreSet arc(double r, const std::vector<double>& angles) {
    Points points;
    for (const double a : angles)
        points.emplace_back(r * std::cos(a), r * std::sin(a), 0.0);
    return one_fibre(points);
}

/// Points on an ellipse with half axes a and 1, unevenly spaced by about `step`: largest error of an inner tangent.
double largest_tangent_error(double a, double step) {
    Points points, exact;
    for (int i = 0; i < 3.0 / step; ++i) {
        const double at = step * (i + (i % 2 == 0 ? 0.0 : 0.4));
        points.emplace_back(a * std::cos(at), std::sin(at), 0.0);
        exact.push_back(Vec3(-a * std::sin(at), std::cos(at), 0.0).normalized());
    }
    const Points tangents = fibre_tangents(one_fibre(points));
    double worst = 0.0;
    for (std::size_t i = 1; i + 1 < points.size(); ++i)
        worst = std::max(worst, (tangents[i] - exact[i]).norm());
    return worst;
}

} // namespace

TEST_CASE("lengths of fibres by hand", "[anatomy][fibre]") {
    const FibreSet fibres =
        straight_fibres({{Vec3(0, 0, 0), Vec3(3, 4, 0)}, {Vec3(1, 1, 1), Vec3(1, 1, 1)}}, 7);
    const std::vector<double> lengths = fibre_lengths(fibres);
    REQUIRE(lengths.size() == 2);
    CHECK(lengths[0] == Approx(5.0).epsilon(1e-14));
    CHECK(lengths[1] == 0.0);
    // A polygon in a circle: n chords of 2 r sin(a / 2).
    CHECK(fibre_lengths(arc(2.0, {0.0, 0.25, 0.5, 0.75}))[0] ==
          Approx(3 * 4.0 * std::sin(0.125)).epsilon(1e-14));
    CHECK(fibre_lengths(one_fibre({Vec3(0, 0, 0), Vec3(0, 0, -2)})) == std::vector<double>{2.0});
    CHECK(fibre_lengths(FibreSet{}).empty());
}

TEST_CASE("strain is the change of length against rest", "[anatomy][fibre]") {
    const std::vector<double> strains =
        fibre_strains(std::vector<double>{12, 5, 0, 3}, std::vector<double>{10, 10, 10, 0});
    CHECK(strains[0] == Approx(0.2));
    CHECK(strains[1] == -0.5);
    CHECK(strains[2] == -1.0);
    CHECK(std::isnan(strains[3]));
}

TEST_CASE("stretch by segment and at points", "[anatomy][fibre]") {
    const FibreSet rest = one_fibre({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(3, 0, 0), Vec3(3, 0, 0)});
    const FibreSet now = one_fibre({Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(2, 3, 0), Vec3(2, 3, 1)});
    const std::vector<double> segments = segment_stretch(now, rest);
    REQUIRE(segments.size() == 3);
    CHECK(segments[0] == 2.0);
    CHECK(segments[1] == 1.5);
    CHECK(std::isnan(segments[2])); // no length at rest
    const std::vector<double> points = point_stretch(now, rest);
    REQUIRE(points.size() == 4);
    CHECK(points[0] == 2.0);
    CHECK(points[1] == Approx(5.0 / 3.0));
    CHECK(points[2] == Approx(4.0 / 2.0));
    CHECK(std::isnan(points[3]));
    CHECK(point_stretch(rest, rest)[1] == 1.0);
    const FibreSet two = straight_fibres({{Vec3(0, 0, 0), Vec3(1, 0, 0)}, {Vec3(0, 0, 0), Vec3(0, 1, 0)}});
    CHECK(point_stretch(two, two) == std::vector<double>{1, 1, 1, 1}); // fibres do not look at each other
}

TEST_CASE("tangents are second order on uneven points, exact on circles", "[anatomy][fibre]") {
    CHECK(largest_tangent_error(1.0, 0.3) < 1e-14);
    const double coarse = largest_tangent_error(3.0, 0.04), fine = largest_tangent_error(3.0, 0.02);
    CHECK(coarse < 5e-3);
    CHECK(coarse / fine > 3.2); // 4 for the second order, 2 would be the first
    const Points ends = fibre_tangents(arc(1.0, {0.0, 0.2, 0.4}));
    CHECK((ends[0] - Vec3(-std::sin(0.1), std::cos(0.1), 0)).norm() < 1e-14);
    CHECK((ends[2] - Vec3(-std::sin(0.3), std::cos(0.3), 0)).norm() < 1e-14);
}

TEST_CASE("tangents where a fibre has no length or turns back", "[anatomy][fibre]") {
    const Vec3 x(1, 0, 0), y(0, 1, 0);
    // Doubled points at both ends and inside.
    const Points doubled = fibre_tangents(one_fibre(
        {Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(1, 1, 0)}));
    CHECK(doubled[0] == x);
    CHECK(doubled[1] == x);
    CHECK((doubled[2] - (x + y).normalized()).norm() < 1e-15);
    CHECK((doubled[3] - (x + y).normalized()).norm() < 1e-15);
    CHECK(doubled[5] == y);
    const Points back = fibre_tangents(one_fibre({Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(1, 0, 0)}));
    CHECK(back[1] == x);
    CHECK(back[2] == -x);
    for (const Vec3& t : fibre_tangents(one_fibre({y, y, y})))
        CHECK(t == Vec3::Zero());
    // Lengths whose squares leave the range of doubles.
    CHECK(fibre_tangents(one_fibre({Vec3(0, 0, 0), Vec3(1e-150, 0, 0), Vec3(2e-150, 0, 0)}))[1] == x);
}

TEST_CASE("fibres that are not fibres are refused", "[anatomy][fibre]") {
    FibreSet fibres = straight_fibres({{Vec3(0, 0, 0), Vec3(1, 0, 0)}, {Vec3(0, 1, 0), Vec3(1, 1, 0)}}, 3);
    CHECK_NOTHROW(check_fibres(fibres, "psoas"));
    CHECK_NOTHROW(check_fibres(FibreSet{}, "psoas"));
    FibreSet bad = fibres;
    bad.points[6].y() = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH(check_fibres(bad, "psoas"), Contains("psoas: point 2 of fibre 1 is not finite"));
    bad.points[6].y() = std::numeric_limits<double>::infinity();
    CHECK_THROWS_AS(check_fibres(bad, "psoas"), Error);
    bad = fibres;
    bad.points.pop_back();
    CHECK_THROWS_WITH(check_fibres(bad, "psoas"), Contains("7 fibre points; expected 8"));
    bad = fibres;
    bad.segments = 0;
    CHECK_THROWS_WITH(check_fibres(bad, "psoas"), Contains("0 segments"));
    bad = fibres;
    bad.count = -1;
    CHECK_THROWS_AS(check_fibres(bad, "psoas"), Error);
}
