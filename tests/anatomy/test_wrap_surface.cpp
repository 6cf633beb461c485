#include "anatomy/string_oracle.hpp"
#include "fascicle/anatomy/ellipsoid_geodesic.hpp"
#include "fascicle/anatomy/wrap_surface.hpp"

#include <catch2/catch.hpp>
#include <random>

using namespace fascicle;

namespace {

constexpr double pi = std::numbers::pi;

WrapSurface sphere(double r, int axis = 0, int sign = 0) {
    WrapSurface s;
    s.shape = WrapShape::sphere;
    s.radius = r;
    s.side_axis = axis;
    s.side_sign = sign;
    return s;
}

WrapSurface cylinder(double r, double length, int axis = 0, int sign = 0) {
    WrapSurface s = sphere(r, axis, sign);
    s.shape = WrapShape::cylinder;
    s.length = length;
    return s;
}

WrapSurface ellipsoid(const Vec3& radii, int axis = 0, int sign = 0) {
    WrapSurface s;
    s.shape = WrapShape::ellipsoid;
    s.radii = radii;
    s.side_axis = axis;
    s.side_sign = sign;
    return s;
}

double total(const WrapContact& c, const Vec3& p, const Vec3& q) {
    return (c.first - p).norm() + c.surface_length + (q - c.second).norm();
}

Vec3 out_of_sphere(const Vec3& x, double r) {
    return x.norm() < r ? Vec3(r * x.normalized()) : x;
}

Vec3 out_of_cylinder(const Vec3& x, double r) {
    const double d = x.head<2>().norm();
    return d < r ? Vec3(x.x() * r / d, x.y() * r / d, x.z()) : x;
}

/// The curve runs from first to second over the surface and is as long as it says, less what chords leave out.
void check_curve(const WrapContact& c, const std::vector<Vec3>& curve,
                 const std::function<double(const Vec3&)>& level) {
    REQUIRE(curve.size() > 2);
    CHECK((curve.front() - c.first).norm() < 1e-12);
    CHECK((curve.back() - c.second).norm() < 1e-12);
    double length = 0;
    for (std::size_t i = 0; i + 1 < curve.size(); ++i)
        length += (curve[i + 1] - curve[i]).norm();
    CHECK(length <= c.surface_length * (1 + 1e-12));
    CHECK(length > c.surface_length * 0.999);
    for (const Vec3& x : curve)
        CHECK(std::abs(level(x)) < 1e-8);
}

} // namespace

TEST_CASE("sphere: a known wrap, its tangents and its curve", "[anatomy][wrap]") {
    // Both ends at distance 2 of a unit sphere: 60 degrees each before the arc begins. 150 degrees apart: 30 are left.
    const Vec3 p(2, 0, 0), q(2 * std::cos(150 * pi / 180), 2 * std::sin(150 * pi / 180), 0);
    std::vector<Vec3> curve;
    const WrapContact c = wrap_segment(sphere(1), p, q, &curve);
    CHECK(c.outcome == WrapOutcome::wrapped);
    CHECK(c.surface_length == Approx(30 * pi / 180));
    CHECK((c.first - p).norm() == Approx(std::sqrt(3.0)));
    CHECK((c.second - q).norm() == Approx(std::sqrt(3.0)));
    CHECK(std::abs(c.first.dot(c.first - p)) < 1e-14); // tangent
    CHECK(std::abs(c.second.dot(c.second - q)) < 1e-14);
    check_curve(c, curve, [](const Vec3& x) { return x.norm() - 1; });
}

TEST_CASE("sphere: who does not wrap", "[anatomy][wrap]") {
    std::vector<Vec3> curve{Vec3::Zero()};
    const auto outcome = [&](const Vec3& p, const Vec3& q) {
        return wrap_segment(sphere(1), p, q, &curve).outcome;
    };
    CHECK(outcome(Vec3(0.5, 0, 0), Vec3(3, 0, 0)) == WrapOutcome::inside);
    CHECK(outcome(Vec3(3, 0, 0), Vec3(0, 0.999, 0)) == WrapOutcome::inside);
    CHECK(outcome(Vec3(-2, 1.001, 0), Vec3(2, 1.001, 0)) == WrapOutcome::none);
    CHECK(outcome(Vec3(2, 0, 0), Vec3(4, 0, 0)) == WrapOutcome::none); // on the line, but beyond
    CHECK(outcome(Vec3(2, 0, 0), Vec3(2, 0, 0)) == WrapOutcome::none);
    CHECK(outcome(Vec3(2, std::nan(""), 0), Vec3(-2, 0, 0)) == WrapOutcome::none);
    CHECK(curve.empty());
    WrapSurface torus;
    torus.shape = WrapShape::torus;
    CHECK(wrap_segment(torus, Vec3(2, 0, 0), Vec3(-2, 0, 0), nullptr).outcome == WrapOutcome::none);
}

TEST_CASE("sphere: through the centre every plane is as good, and the constrained side is taken",
          "[anatomy][wrap]") {
    const Vec3 p(3, 0, 0), q(-3, 0, 0);
    const double wanted = 2 * std::sqrt(8.0) + pi - 2 * std::acos(1.0 / 3);
    CHECK(total(wrap_segment(sphere(1), p, q, nullptr), p, q) == Approx(wanted));
    for (const int sign : {1, -1}) {
        const WrapContact c = wrap_segment(sphere(1, 2, sign), p, q, nullptr);
        CHECK(total(c, p, q) == Approx(wanted));
        CHECK(sign * c.first.z() > 0.5);
        CHECK(sign * c.second.z() > 0.5);
    }
}

TEST_CASE("sphere: a constrained side may lead the long way round", "[anatomy][wrap]") {
    const Vec3 p(-2, -0.1, 0), q(2, -0.1, 0);
    const WrapContact free = wrap_segment(sphere(1), p, q, nullptr);
    const WrapContact down = wrap_segment(sphere(1, 1, -1), p, q, nullptr);
    const WrapContact up = wrap_segment(sphere(1, 1, 1), p, q, nullptr);
    CHECK(free.first.y() < 0);
    CHECK((down.first - free.first).norm() < 1e-15);
    CHECK(down.outcome == WrapOutcome::mandatory); // both ends on that side
    CHECK(up.outcome == WrapOutcome::wrapped);
    CHECK(up.first.y() > 0.7);
    CHECK(up.second.y() > 0.7);
    CHECK(up.surface_length > down.surface_length);
    // Both ways together and the angles of the four tangents make a full turn.
    const double at_end = std::acos(1 / p.norm());
    CHECK(up.surface_length + down.surface_length + 4 * at_end == Approx(2 * pi));
}

TEST_CASE("sphere: never longer than a tightened string, for many ends", "[anatomy][wrap]") {
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    const auto outside = [&] {
        const Vec3 direction = Vec3(normal(random), normal(random), normal(random)).normalized();
        return Vec3((1.05 + std::abs(normal(random))) * direction);
    };
    int wrapped = 0;
    for (int i = 0; i < 300 && wrapped < 12; ++i) {
        const Vec3 p = outside(), q = outside();
        const WrapContact c = wrap_segment(sphere(1), p, q, nullptr);
        if (!c.wraps() || std::abs(c.surface_length) > 2.8) // nearly opposite: the string finds either side
            continue;
        ++wrapped;
        const double length = total(c, p, q);
        CHECK(length > (q - p).norm());
        CHECK(length == Approx(test::string_length(p, q, [](const Vec3& x) {
                            return out_of_sphere(x, 1);
                        })).epsilon(3e-5));
    }
    CHECK(wrapped == 12);
}

TEST_CASE("cylinder: across it is a circle, along it a straight line on the unrolled surface",
          "[anatomy][wrap]") {
    const double a = 150 * pi / 180;
    for (const double rise : {0.0, 1.5, -4.0}) {
        const Vec3 p(2, 0, -rise / 2), q(2 * std::cos(a), 2 * std::sin(a), rise / 2);
        std::vector<Vec3> curve;
        const WrapContact c = wrap_segment(cylinder(1, 10), p, q, &curve);
        CHECK(c.outcome == WrapOutcome::mandatory);
        const double flat = 2 * std::sqrt(3.0) + pi / 6;
        CHECK(total(c, p, q) == Approx(std::hypot(flat, rise)));
        CHECK(c.first.z() == Approx(p.z() + rise * std::sqrt(3.0) / flat).margin(1e-12));
        // The path goes on without a corner.
        const Vec3 into = (c.first - p).normalized(), on = (curve[1] - c.first).normalized();
        CHECK(into.dot(on) > 0.998);
        check_curve(c, curve, [](const Vec3& x) { return x.head<2>().norm() - 1; });
        CHECK(total(c, p, q) == Approx(test::string_length(p, q, [](const Vec3& x) {
                                    return out_of_cylinder(x, 1);
                                })).epsilon(3e-5));
    }
}

TEST_CASE("cylinder: who does not wrap", "[anatomy][wrap]") {
    const auto outcome = [](const WrapSurface& s, const Vec3& p, const Vec3& q) {
        return wrap_segment(s, p, q, nullptr).outcome;
    };
    CHECK(outcome(cylinder(1, 4), Vec3(0.9, 0, 8), Vec3(3, 0, 0)) ==
          WrapOutcome::inside); // its axis goes on and on
    CHECK(outcome(cylinder(1, 4), Vec3(-2, 1.1, 0), Vec3(2, 1.1, 0)) == WrapOutcome::none);
    CHECK(outcome(cylinder(1, 4), Vec3(2, 0, 0), Vec3(5, 0, 0)) == WrapOutcome::none);
    CHECK(outcome(cylinder(1, 4), Vec3(-2, 0, 5), Vec3(2, 0, 5)) == WrapOutcome::none); // beyond the end
    CHECK(outcome(cylinder(1, 4), Vec3(-2, 0, 1.9), Vec3(2, 0, 1.9)) == WrapOutcome::mandatory);
    CHECK(outcome(cylinder(1, 4), Vec3(2, 0, -5), Vec3(2, 0, 5)) == WrapOutcome::none); // along the axis
}

TEST_CASE("cylinder: a constrained side pulls the path over to it", "[anatomy][wrap]") {
    const WrapSurface up = cylinder(1, 10, 1, 1);
    // Both ends below, the line below the cylinder: round the top all the same.
    const Vec3 p(-2, -1.5, 0), q(2, -1.5, 0);
    const WrapContact over = wrap_segment(up, p, q, nullptr);
    CHECK(over.outcome == WrapOutcome::wrapped);
    const double at_end = std::acos(1 / 2.5), gone = 2 * pi - 2 * std::atan2(2.0, 1.5);
    CHECK(over.surface_length == Approx(gone - 2 * at_end));
    // Both ends above: only what passes through.
    CHECK(wrap_segment(up, -p, -q, nullptr).outcome == WrapOutcome::none);
    const Vec3 r(-2, 0.2, 0), s(2, 0.2, 0);
    const WrapContact through = wrap_segment(up, r, s, nullptr);
    CHECK(through.outcome == WrapOutcome::mandatory);
    CHECK(through.first.y() > 0);
    // One above, one below, passing below the axis: over the top; passing above: straight.
    const WrapContact low = wrap_segment(up, Vec3(-2, 0.5, 0), Vec3(0.5, -2, 0), nullptr);
    CHECK(low.outcome == WrapOutcome::wrapped);
    CHECK(low.first.y() > 0);
    CHECK(wrap_segment(up, Vec3(-2, 3, 0), Vec3(2, -0.1, 0), nullptr).outcome == WrapOutcome::none);
    // The other way for the other side.
    CHECK(wrap_segment(cylinder(1, 10, 1, -1), r, s, nullptr).first.y() < 0);
}

TEST_CASE("ellipsoid: nearest point is on the surface, straight below, and nearest", "[anatomy][wrap]") {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> number(-2, 2), size(0.3, 1.5);
    for (int i = 0; i < 200; ++i) {
        const Vec3 a(size(random), size(random), size(random));
        Vec3 p(number(random), number(random), number(random));
        if (i % 4 == 0)
            p[i / 4 % 3] = 0;
        if (i % 10 == 0)
            p *= 0.05;
        const Vec3 x = closest_on_ellipsoid(a, p);
        CHECK(std::abs(x.cwiseQuotient(a).squaredNorm() - 1) < 1e-9);
        const double distance = (x - p).norm();
        for (int k = 0; k < 40; ++k) { // no other point is nearer
            const Vec3 y = Vec3(number(random), number(random), number(random)).normalized().cwiseProduct(a);
            CHECK((y - p).norm() > distance - 1e-9);
        }
        const Vec3 normal = x.cwiseQuotient(a.cwiseProduct(a)).normalized();
        CHECK((x - p).cross(normal).norm() < 1e-7);
    }
    CHECK(closest_on_ellipsoid(Vec3(3, 2, 1), Vec3::Zero()).isApprox(Vec3(0, 0, 1)));
}

TEST_CASE("ellipsoid: equal radii are a sphere", "[anatomy][wrap]") {
    const Vec3 p(2, 0.3, -0.2), q(-1.5, 0.4, 1.1);
    const WrapContact round = wrap_segment(sphere(0.9), p, q, nullptr);
    const WrapContact c = wrap_segment(ellipsoid(Vec3(0.9, 0.9, 0.9)), p, q, nullptr);
    CHECK(c.outcome == WrapOutcome::mandatory);
    CHECK(total(c, p, q) == Approx(total(round, p, q)).epsilon(3e-9));
    CHECK((c.first - round.first).norm() < 1e-7);
    CHECK((c.second - round.second).norm() < 1e-7);
    // A constrained side with the whole of the long way on it.
    const Vec3 r(-2, -0.1, 0), s(2, -0.1, 0);
    const WrapContact up = wrap_segment(ellipsoid(Vec3(1, 1, 1), 1, 1), r, s, nullptr);
    CHECK(total(up, r, s) == Approx(total(wrap_segment(sphere(1, 1, 1), r, s, nullptr), r, s)).epsilon(3e-9));
    CHECK(up.first.y() > 0.5);
}

TEST_CASE("ellipsoid: the geodesic is as short as a tightened string, and found every time",
          "[anatomy][wrap]") {
    std::mt19937 random(11);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> size(0.35, 1.6);
    int found = 0, checked = 0, wraps = 0;
    for (int i = 0; i < 4000 && wraps < 300; ++i) {
        const Vec3 a(size(random), size(random), size(random));
        const auto outside = [&] {
            const Vec3 direction = Vec3(normal(random), normal(random), normal(random)).normalized();
            return Vec3((1.02 + std::abs(normal(random))) * direction.cwiseProduct(a));
        };
        const Vec3 p = outside(), q = outside();
        std::vector<Vec3> curve;
        const WrapContact c = wrap_segment(ellipsoid(a), p, q, &curve);
        if (!c.wraps())
            continue;
        ++wraps;
        const EllipsoidPath path = ellipsoid_geodesic(a, p, q, 0, 0, nullptr);
        found += path.geodesic ? 1 : 0;
        const double length = total(c, p, q);
        CHECK(length > (q - p).norm());
        if (wraps % 20 != 0)
            continue;
        ++checked;
        check_curve(c, curve, [&](const Vec3& x) { return x.cwiseQuotient(a).norm() - 1; });
        const auto push_out = [&](const Vec3& x) {
            return x.cwiseQuotient(a).squaredNorm() < 1 ? closest_on_ellipsoid(a, x) : x;
        };
        // The string starts on the side that the path lies on.
        const Vec3 middle = curve[curve.size() / 2];
        const double by_string = test::string_length(p, q, push_out, middle - (p + q) / 2, 6);
        INFO(a.transpose() << " | " << p.transpose() << " | " << q.transpose());
        CHECK(length == Approx(by_string).epsilon(2e-4));
        CHECK(length < by_string * (1 + 2e-4));
    }
    CHECK(wraps == 300);
    CHECK(checked == 15);
    CHECK(found == wraps);
}

TEST_CASE("ellipsoid: ends on the surface, grazing lines, flat shapes", "[anatomy][wrap]") {
    const Vec3 a(1, 0.6, 0.8);
    const Vec3 on = Vec3(0.6, 0.64, 0.48).normalized().cwiseProduct(a) * (1 + 1e-12);
    const Vec3 q(-2, -0.5, 0.3);
    const WrapContact c = wrap_segment(ellipsoid(a), on, q, nullptr);
    REQUIRE(c.wraps());
    CHECK((c.first - on).norm() < 1e-5);
    const double length = total(c, on, q);
    const auto push_out = [&](const Vec3& x) {
        return x.cwiseQuotient(a).squaredNorm() < 1 ? closest_on_ellipsoid(a, x) : x;
    };
    CHECK(length == Approx(test::string_length(on, q, push_out)).epsilon(1e-4));
    // Hardly touching: hardly longer.
    const Vec3 r(-2, 0.6 - 1e-7, 0), s(2, 0.6 - 1e-7, 0);
    const WrapContact graze = wrap_segment(ellipsoid(a), r, s, nullptr);
    REQUIRE(graze.wraps());
    CHECK(total(graze, r, s) == Approx(4).epsilon(3e-9));
    CHECK(total(graze, r, s) >= 4);
    // A disc: over its rim.
    const Vec3 flat(1, 1, 0.05), t(0.1, 0, -0.5), u(0, 0.1, 0.5);
    const WrapContact disc = wrap_segment(ellipsoid(flat), t, u, nullptr);
    REQUIRE(disc.wraps());
    CHECK(total(disc, t, u) > 2);
    CHECK(total(disc, t, u) < 2.5);
}

TEST_CASE("Radii without digits in common have no geodesic", "[anatomy][wrap]") {
    // A number of steps was made of nan, which only a sanitizer tells (preset asan).
    const EllipsoidPath path =
        ellipsoid_geodesic({0.1e307, 0.1, 0.7}, {0.1, 0.2, 0.9}, {-0.1, -0.2, -0.9}, 0, 0, nullptr);
    CHECK_FALSE(path.geodesic);
}
