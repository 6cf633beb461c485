#include "fascicle/geometry/centripetal_spline.hpp"
#include "geometry/surface_oracles.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace fascicle;

namespace {

Points random_points(test::Random& random, int count) {
    Points points;
    for (int i = 0; i < count; ++i)
        points.push_back(random.in_box(Vec3::Constant(-10), Vec3::Constant(10)));
    return points;
}

/// The pyramid of Barry & Goldman over four points and their knots, at t in [t1, t2].
Vec3 pyramid(const Vec3& p0, const Vec3& p1, const Vec3& p2, const Vec3& p3, const std::array<double, 4>& t,
             double at) {
    const auto between = [&](const Vec3& a, const Vec3& b, double from, double to) {
        return Vec3((to - at) / (to - from) * a + (at - from) / (to - from) * b);
    };
    const Vec3 a1 = between(p0, p1, t[0], t[1]), a2 = between(p1, p2, t[1], t[2]),
               a3 = between(p2, p3, t[2], t[3]);
    const Vec3 b1 = between(a1, a2, t[0], t[2]), b2 = between(a2, a3, t[1], t[3]);
    return between(b1, b2, t[1], t[2]);
}

} // namespace

TEST_CASE("the centripetal curve is the pyramid's, mirrored at its ends", "[geometry][centripetal_spline]") {
    test::Random random(4);
    for (int trial = 0; trial < 20; ++trial) {
        const Points p = random_points(random, 6);
        const CentripetalSpline spline(p);
        const auto knot = [&](const Vec3& a, const Vec3& b) { return std::sqrt((b - a).norm()); };
        for (int span = 0; span < spline.spans(); ++span) {
            const auto i = static_cast<std::size_t>(span);
            const Vec3 before = i > 0 ? p[i - 1] : Vec3(2 * p[0] - p[1]);
            const Vec3 after = i + 2 < p.size() ? p[i + 2] : Vec3(2 * p[5] - p[4]);
            std::array<double, 4> t{};
            t[1] = t[0] + knot(before, p[i]);
            t[2] = t[1] + knot(p[i], p[i + 1]);
            t[3] = t[2] + knot(p[i + 1], after);
            for (const double share : {0.0, 0.2, 0.5, 0.9, 1.0}) {
                const Vec3 expected = pyramid(before, p[i], p[i + 1], after, t, t[1] + share * (t[2] - t[1]));
                CHECK((spline.at(span, share) - expected).norm() < 1e-10);
            }
        }
    }
}

TEST_CASE("the centripetal curve passes through its points with the tangents of the formula",
          "[geometry][centripetal_spline]") {
    test::Random random(5);
    const Points p = random_points(random, 7);
    const CentripetalSpline spline(p);
    const std::vector<double>& t = spline.knots();
    for (std::size_t i = 0; i + 1 < p.size(); ++i) {
        CHECK(t[i + 1] - t[i] == Approx(std::sqrt((p[i + 1] - p[i]).norm())));
        CHECK(spline.at(static_cast<int>(i), 0.0) == p[i]);
        CHECK(spline.at(static_cast<int>(i), 1.0) == p[i + 1]);
        const double length = t[i + 1] - t[i], h = 1e-6;
        const Vec3 start = (spline.at(static_cast<int>(i), h) - p[i]) / (h * length);
        const Vec3 end = (p[i + 1] - spline.at(static_cast<int>(i), 1.0 - h)) / (h * length);
        CHECK((start - spline.tangents()[i]).norm() < 1e-4); // so it is smooth at every knot
        CHECK((end - spline.tangents()[i + 1]).norm() < 1e-4);
        if (i > 0) {
            const Vec3 formula = (p[i] - p[i - 1]) / (t[i] - t[i - 1]) -
                                 (p[i + 1] - p[i - 1]) / (t[i + 1] - t[i - 1]) +
                                 (p[i + 1] - p[i]) / (t[i + 1] - t[i]);
            CHECK((spline.tangents()[i] - formula).norm() < 1e-12);
        }
    }
    CHECK((spline.tangents()[0] - (p[1] - p[0]) / (t[1] - t[0])).norm() < 1e-12);
    CHECK((spline.tangents()[6] - (p[6] - p[5]) / (t[6] - t[5])).norm() < 1e-12);
}

TEST_CASE("the centripetal curve follows similarities, and any affine motion when its knots are kept",
          "[geometry][centripetal_spline]") {
    test::Random random(6);
    const Points p = random_points(random, 5);
    const CentripetalSpline spline(p);
    Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix() * 2.5;
    Mat3 shear;
    shear << 1, 0.4, -2, 0, 3, 0.1, 0.5, 0, 0.2;
    const Vec3 shift(3, -1, 8);
    const auto moved = [&](const Mat3& m) {
        Points q;
        for (const Vec3& x : p)
            q.push_back(m * x + shift);
        return q;
    };
    const CentripetalSpline similar(moved(turn)), affine(moved(shear), spline.knots());
    for (int span = 0; span < spline.spans(); ++span)
        for (const double share : {0.1, 0.5, 0.8}) {
            const Vec3 x = spline.at(span, share);
            CHECK((similar.at(span, share) - (turn * x + shift)).norm() < 1e-10);
            CHECK((affine.at(span, share) - (shear * x + shift)).norm() < 1e-10);
        }
}

TEST_CASE("centripetal curves through equal, few or collinear points", "[geometry][centripetal_spline]") {
    const Vec3 a(1, 2, 3), b(4, 0, -1);
    const CentripetalSpline two({a, b});
    CHECK((two.at(0, 0.25) - (0.75 * a + 0.25 * b)).norm() < 1e-12);
    CHECK(CentripetalSpline(Points{a}).spans() == 0);
    const CentripetalSpline repeated({a, a, b, b, b, a});
    for (int span = 0; span < repeated.spans(); ++span)
        for (const double share : {0.0, 0.3, 1.0})
            CHECK(repeated.at(span, share).allFinite());
    CHECK(repeated.at(0, 0.5) == a);
    CHECK((repeated.at(1, 0.5) - 0.5 * (a + b)).norm() < 1e-12);
    const CentripetalSpline line({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(9, 0, 0), Vec3(10, 0, 0)});
    double last = -1;
    for (int span = 0; span < 3; ++span)
        for (int k = 0; k < 10; ++k) {
            const double x = line.at(span, 0.1 * k).x();
            CHECK(x > last); // uneven points on a line: no turning back
            last = x;
        }
}
