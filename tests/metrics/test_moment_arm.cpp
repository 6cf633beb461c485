#include "fascicle/metrics/moment_arm.hpp"

#include "fascicle/base/error.hpp"
#include "support/fibres.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

using namespace fascicle;
using namespace fascicle::test;
using Catch::Matchers::Contains;

namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
constexpr double degree = std::numbers::pi / 180.0;
const ArmOptions central{ArmMethod::central_difference};

using Course = std::vector<double>;

Course evenly(double from, double to, int steps) {
    Course angles;
    for (int i = 0; i <= steps; ++i)
        angles.push_back(from + (to - from) * i / steps);
    return angles;
}

Course joined(std::initializer_list<Course> parts) {
    Course all;
    for (const Course& part : parts)
        all.insert(all.end(), part.begin(), part.end());
    return all;
}

/// Arms of one fibre.
Course arms_of(const Course& angles, const std::function<double(double)>& length, double sign = 1.0,
               const ArmOptions& options = {}) {
    Course lengths;
    for (const double a : angles)
        lengths.push_back(length(a));
    return excursion_arms(angles, lengths, 1, sign, options);
}

double largest_error(const Course& angles, const Course& arms, const std::function<double(double)>& exact) {
    double worst = 0.0;
    for (std::size_t k = 0; k < arms.size(); ++k)
        worst = std::max(worst, std::abs(arms[k] - exact(angles[k])));
    return worst;
}

using Spans = std::vector<MotionSpan>;

/// A straight fibre from a fixed origin to a point that turns about an oblique hinge.
struct TurningFibre {
    Hinge hinge{Vec3(144, 243, -433), Vec3(2, 0.3, -0.1)};
    Vec3 origin{150, 200, -340}, insertion{120, 250, -480};

    FibreSet at(double angle) const {
        const Pose pose = rotation_about(hinge.centre, hinge.axis, angle);
        return straight_fibres({{origin, pose.apply(insertion)}}, 6);
    }
    double length(double angle) const { return fibre_lengths(at(angle))[0]; }
    /// By the cosine law in the plane across the axis: L^2 = h^2 + u^2 + v^2 - 2 u v cos(angle + phase), so
    /// -dL/dangle = -u v sin(angle + phase) / L.
    double exact(double angle) const {
        const Vec3 a = hinge.axis.normalized();
        const auto across = [&](const Vec3& p) {
            return Vec3((p - hinge.centre) - a * a.dot(p - hinge.centre));
        };
        const Vec3 u = across(origin), v = across(insertion);
        const double phase = std::atan2(a.dot(u.cross(v)), u.dot(v)), h = a.dot(origin - insertion);
        const double uv = u.norm() * v.norm();
        const double length =
            std::sqrt(h * h + u.squaredNorm() + v.squaredNorm() - 2.0 * uv * std::cos(angle + phase));
        return -uv * std::sin(angle + phase) / length;
    }
};

} // namespace

TEST_CASE("the way a motion bends its joint", "[metrics][moment_arm]") {
    CHECK(flexion_sign(Course{0, -0.5, -1, -0.5, 0}) == -1.0);
    CHECK(flexion_sign(Course{0, 0.2, -1, 0}) == -1.0);
    CHECK(flexion_sign(Course{0.7, 1.0, 0.7}) == 1.0);
    CHECK(flexion_sign(Course{0, -0.5, 0.5}) == -1.0); // as far both ways: the first
    CHECK(flexion_sign(Course{3, 3, 3}) == 1.0);
    CHECK(flexion_sign(Course{}) == 1.0);
    Timeline timeline = make_hinge_timeline(Hinge{}, -1.0, Phases{}, 1, {0});
    CHECK(flexion_sign(timeline) == -1.0);
    CHECK(flexion_sign(make_hinge_timeline(Hinge{}, 0.3, Phases{}, 1, {0})) == 1.0);
    timeline.angles = {{0, 0.0}, {50, 0.3}, {400, -5.0}}; // the motion ends at frame 300
    CHECK(flexion_sign(timeline) == -1.0);
    timeline.angles = {{0, 0.0}, {50, 0.3}, {301, 0.0}, {400, -5.0}};
    CHECK(flexion_sign(timeline) == 1.0);
    CHECK(flexion_sign(Timeline{}) == 1.0);
}

TEST_CASE("a motion falls into spans that go one way", "[metrics][moment_arm]") {
    CHECK(motion_spans(Course{0, 1, 2, 1, 0}) == Spans{{0, 2}, {2, 4}});
    CHECK(motion_spans(Course{0, 0, 1, 2, 2, 2, 1, 0, 0}) ==
          Spans{{1, 3}, {5, 7}});                             // still frames are left out
    CHECK(motion_spans(Course{0, 1, 1, 2}) == Spans{{0, 3}}); // but not within a span
    CHECK(motion_spans(Course{0, -1, 2, -3}) == Spans{{0, 1}, {1, 2}, {2, 3}});
    CHECK(motion_spans(Course{1, 2}) == Spans{{0, 1}});
    CHECK(motion_spans(Course{5, 5, 5}).empty());
    CHECK(motion_spans(Course{5}).empty());
    CHECK(motion_spans(Course{}).empty());
    CHECK(motion_spans(Course{0, 1e-8, 0}).empty()); // rounding, not a motion
    // Small motions have small turns: 0.1 degrees out and back.
    CHECK(motion_spans(joined({evenly(0, 0.1 * degree, 10), evenly(0.1 * degree, 0, 10)})) ==
          Spans{{0, 10}, {11, 21}});
    CHECK_THROWS_WITH(motion_spans(Course{0, undefined, 1}), Contains("frame 1 is not finite"));
    CHECK_THROWS_AS(motion_spans(Course{0, std::numeric_limits<double>::infinity()}), Error);
}

TEST_CASE("noise of a measured motion is no turn", "[metrics][moment_arm]") {
    Course angles = joined({evenly(0, -1, 100), evenly(-1, 0, 100)});
    for (std::size_t k = 0; k < angles.size(); ++k)
        angles[k] += 0.1 * degree * std::sin(double(k * k)); // steps are 0.57 degrees, so some go back
    for (std::size_t k = 10; k < 90; k += 7)
        angles[k] = angles[k - 1] + 0.2 * degree;
    const Spans spans = motion_spans(angles);
    REQUIRE(spans.size() == 2);
    CHECK(spans[0].first <= 1);
    CHECK(spans[0].last == Approx(100).margin(2));
    CHECK(spans[1].last == Approx(201).margin(2));
}

TEST_CASE("a fibre on a pulley has the pulley's radius as its arm", "[metrics][moment_arm]") {
    const Course out = evenly(0.0, 1.2, 60), angles = joined({out, evenly(1.2, 0.0, 60), Course(20, 0.0)});
    for (const ArmOptions& options : {ArmOptions{}, central}) {
        const auto pulley = [](double a) { return 180.0 - 23.0 * a; };
        CHECK(largest_error(angles, arms_of(angles, pulley, 1.0, options), [](double) { return 23.0; }) <
              1e-9);
        // Wound the other way, and the same fibre in a motion that counts its angle the other way.
        const auto unwound = [](double a) { return 180.0 + 23.0 * a; };
        CHECK(largest_error(angles, arms_of(angles, unwound, 1.0, options), [](double) { return -23.0; }) <
              1e-9);
        Course negative = angles;
        for (double& a : negative)
            a = -a;
        CHECK(largest_error(negative, arms_of(negative, unwound, -1.0, options),
                            [](double) { return 23.0; }) < 1e-9);
    }
}

TEST_CASE("the fit is exact up to its degree wherever the angles lie", "[metrics][moment_arm]") {
    for (const auto& [from, to] : {std::pair{0.0, 1.0}, {-0.4, 0.9}, {6.0, 6.2}, {2.0, -1.0}}) {
        const Course angles = evenly(from, to, 50);
        const double a0 = from;
        for (int n = 1; n <= 5; ++n) {
            const auto length = [&](double a) { return 150.0 + 20.0 * std::pow(a - a0, n); };
            const auto exact = [&](double a) { return -20.0 * n * std::pow(a - a0, n - 1); };
            const double scale = std::max(1.0, std::abs(exact(to)));
            const double error = largest_error(angles, arms_of(angles, length), exact) / scale;
            if (n <= 4)
                CHECK(error < 1e-8);
            else
                CHECK(error > 1e-6); // it is a fit, not an interpolation
        }
        // A lower degree is what it says too.
        ArmOptions linear;
        linear.degree = 1;
        const auto square = [&](double a) { return 10.0 * (a - a0) * (a - a0); };
        const Course arms = arms_of(angles, square, 1.0, linear);
        CHECK(arms.front() == Approx(-10.0 * (to - from)));
        CHECK(arms.back() == Approx(arms.front()));
    }
}

TEST_CASE("the local difference is exact for parabolas, also at ends and on uneven angles",
          "[metrics][moment_arm]") {
    const auto length = [](double a) { return 150.0 + 3.0 * a - 7.0 * a * a; };
    const auto exact = [](double a) { return -3.0 + 14.0 * a; };
    Course angles;
    for (int i = 0; i <= 70; ++i)
        angles.push_back(0.01 * i + 0.002 * (i % 3));
    CHECK(largest_error(angles, arms_of(angles, length, 1.0, central), exact) < 1e-9);
    const Course coarse{0, 0.3, 0.4, 0.9, 1.5}; // further apart than the step
    CHECK(largest_error(coarse, arms_of(coarse, length, 1.0, central), exact) < 1e-10);
    const Course narrow = evenly(0, 0.5 * degree, 6); // all within one step
    CHECK(largest_error(narrow, arms_of(narrow, length, 1.0, central), exact) < 1e-8);
    // It looks 1 degree each way, so a jump of length is nowhere but there.
    const Course fine = evenly(0, 0.6, 600);
    const auto bend = [](double a) { return a < 0.3 ? 0.0 : a - 0.3; };
    const Course arms = arms_of(fine, bend, 1.0, central);
    CHECK(arms[270] == Approx(0.0).margin(1e-12));
    CHECK(arms[330] == Approx(-1.0));
    CHECK(arms[300] == Approx(-0.5).margin(0.02));
}

TEST_CASE("a straight fibre about a hinge: cosine law, excursion and line agree", "[metrics][moment_arm]") {
    const TurningFibre fibre;
    const auto length = [&](double a) { return fibre.length(a); };
    const auto exact = [&](double a) { return fibre.exact(a); };
    const Course angles = evenly(0, -1.0, 100);
    for (const double a : angles) {
        const double line = line_arm(fibre.at(a).fibre(0), FibreEnd::insertion, fibre.hinge, 1.0);
        CHECK(line == Approx(exact(a)).epsilon(1e-11));
        CHECK(line == Approx(-(length(a + 1e-5) - length(a - 1e-5)) / 2e-5).epsilon(1e-6));
    }
    const double size = std::abs(exact(-0.5));
    CHECK(size > 20.0);
    CHECK(largest_error(angles, arms_of(angles, length), exact) < 0.05);
    CHECK(largest_error(angles, arms_of(angles, length, 1.0, central), exact) < 0.05);
    // Second order: half the step, a quarter of the error inside.
    ArmOptions wide = central, half = central;
    wide.step_rad = 0.08;
    half.step_rad = 0.04;
    const double wide_error = std::abs(arms_of(angles, length, 1.0, wide)[50] - exact(angles[50]));
    const double half_error = std::abs(arms_of(angles, length, 1.0, half)[50] - exact(angles[50]));
    CHECK(wide_error / half_error == Approx(4.0).margin(0.3));
    // The motion's flexion is negative: it is in front of the hinge, so it flexes.
    const double sign = flexion_sign(angles);
    CHECK(sign == -1.0);
    const Course flexion = arms_of(angles, length, sign);
    CHECK(length(-1.0) < length(0.0));
    CHECK(flexion[50] > 20.0);
    CHECK(line_arms(fibre.at(-0.5), FibreEnd::insertion, fibre.hinge, sign)[0] ==
          Approx(flexion[50]).epsilon(1e-3));
}

TEST_CASE("the line's arm belongs to the end that moves", "[metrics][moment_arm]") {
    const TurningFibre f;
    const FibreSet forwards = f.at(-0.3);
    Points reversed(forwards.points.rbegin(), forwards.points.rend());
    const FibreSet backwards = one_fibre(reversed);
    const double arm = line_arm(forwards.fibre(0), FibreEnd::insertion, f.hinge, 1.0);
    CHECK(line_arm(backwards.fibre(0), FibreEnd::origin, f.hinge, 1.0) == Approx(arm).epsilon(1e-14));
    // The other bone feels the opposite moment from a straight line.
    CHECK(line_arm(forwards.fibre(0), FibreEnd::origin, f.hinge, 1.0) == Approx(-arm).epsilon(1e-12));
    // Only the last segment with a length counts.
    const Hinge z{Vec3(0, 0, 5), Vec3(0, 0, 10)};
    const FibreSet bent = one_fibre({Vec3(9, 9, 9), Vec3(3, 4, 0), Vec3(3, 0, 1), Vec3(3, 0, 1)});
    CHECK(line_arm(bent.fibre(0), FibreEnd::insertion, z, 1.0) == Approx(3.0 * 4.0 / std::sqrt(17.0)));
    CHECK(std::isnan(line_arm(one_fibre({Vec3(1, 1, 1), Vec3(1, 1, 1)}).fibre(0), FibreEnd::origin, z, 1.0)));
    CHECK_THROWS_WITH(line_arm(bent.fibre(0), FibreEnd::insertion, Hinge{Vec3::Zero(), Vec3::Zero()}, 1.0),
                      Contains("axis without direction"));
}

TEST_CASE("out, hold, back, rest: each way has its own arms and rest keeps them", "[metrics][moment_arm]") {
    const Course angles = joined(
        {Course(5, 0.0), evenly(0.01, 1.0, 99), Course(5, 1.0), evenly(0.99, 0.0, 99), Course(50, 0.0)});
    for (const ArmOptions& options : {ArmOptions{}, central}) {
        Course lengths;
        for (std::size_t k = 0; k < angles.size(); ++k) {
            const double a = angles[k];
            // Out: 200 - 30 a. It creeps while it is held; back: 199 - 28 a - 2 a^2, and creeps at rest too.
            lengths.push_back(k < 105   ? 200 - 30 * a
                              : k < 110 ? 170 - 0.2 * double(k - 104)
                                        : 199 - 28 * a - 2 * a * a);
            if (k >= 210)
                lengths.back() = 199 + 0.01 * double(k - 209);
        }
        const Course arms = excursion_arms(angles, lengths, 1, 1.0, options);
        for (std::size_t k = 0; k <= 104; ++k) // the frames before the motion have the arm of its beginning
            CHECK(arms[k] == Approx(30.0));
        for (std::size_t k = 105; k <= 109; ++k)
            CHECK(arms[k] == arms[104]); // held: the angle says nothing new
        for (std::size_t k = 112; k < 205; ++k)
            CHECK(arms[k] == Approx(28 + 4 * angles[k]).epsilon(2e-2));
        for (std::size_t k = 210; k < angles.size(); ++k)
            CHECK(arms[k] == arms[209]);
    }
}

TEST_CASE("where two ways meet the earlier one has the word", "[metrics][moment_arm]") {
    const Course angles = joined({evenly(0, 1, 20), evenly(0.95, 0, 19)});
    Course lengths;
    for (std::size_t k = 0; k < angles.size(); ++k)
        lengths.push_back(k <= 20 ? 100 - 10 * angles[k] : 110 - 20 * angles[k]); // both 90 at the turn
    const Course arms = excursion_arms(angles, lengths, 1, 1.0);
    CHECK(arms[20] == Approx(10.0));
    CHECK(arms[19] == Approx(10.0));
    CHECK(arms[21] == Approx(20.0));
    CHECK(arms.back() == Approx(20.0));
}

TEST_CASE("few angles give what they can, none give nothing", "[metrics][moment_arm]") {
    for (const ArmOptions& options : {ArmOptions{}, central}) {
        CHECK(excursion_arms(Course{}, Course{}, 3, 1.0, options).empty());
        CHECK(std::isnan(excursion_arms(Course{0.2}, Course{100}, 1, 1.0, options)[0]));
        for (const double r : excursion_arms(Course{0.2, 0.2, 0.2}, Course{100, 101, 102}, 1, 1.0, options))
            CHECK(std::isnan(r));
        const Course two = excursion_arms(Course{0, 0.5}, Course{100, 90}, 1, 1.0, options);
        CHECK(two[0] == Approx(20.0));
        CHECK(two[1] == Approx(20.0));
        const Course three = arms_of(
            Course{0, 0.5, 1.5}, [](double a) { return 5 * a * a; }, 1.0, options);
        CHECK(three[0] == Approx(0.0).margin(1e-9));
        CHECK(three[1] == Approx(-5.0));
        CHECK(three[2] == Approx(-15.0));
        CHECK(excursion_arms(Course{0, 1}, Course{}, 0, 1.0, options).empty());
    }
    // Five distinct angles with several frames each: still a polynomial of the fourth degree.
    Course angles;
    for (int i = 0; i < 25; ++i)
        angles.push_back(0.1 * (i / 5));
    const auto quartic = [](double a) { return 100 + 50 * std::pow(a, 4); };
    CHECK(largest_error(angles, arms_of(angles, quartic), [](double a) { return -200 * a * a * a; }) < 1e-9);
    // Angles that differ by rounding are one: no arm of 1e9 mm.
    const Course nearly{0, 1e-13, 0.5, 0.5 + 1e-13, 1};
    for (const double r : arms_of(nearly, [](double a) { return 100 - 10 * a + 1e-7 * std::sin(1e14 * a); }))
        CHECK(r == Approx(10.0).margin(1e-4));
}

TEST_CASE("a bad length spoils its own fibre only", "[metrics][moment_arm]") {
    const Course angles = evenly(0, 1, 10);
    Course lengths, good;
    for (std::size_t k = 0; k < angles.size(); ++k)
        for (int f = 0; f < 3; ++f) {
            lengths.push_back(f == 1 && k == 4 ? undefined : 100 - 10 * (f + 1) * angles[k]);
            good.push_back(100 - 10 * (f + 1) * angles[k]);
        }
    const Course arms = excursion_arms(angles, lengths, 3, 1.0),
                 reference = excursion_arms(angles, good, 3, 1.0);
    for (std::size_t k = 0; k < angles.size(); ++k) {
        CHECK(arms[3 * k] == reference[3 * k]);
        CHECK(std::isnan(arms[3 * k + 1]));
        CHECK(arms[3 * k + 2] == reference[3 * k + 2]);
    }
    CHECK_THROWS_WITH(excursion_arms(angles, Course(5, 1.0), 1, 1.0),
                      Contains("5 fibre lengths; expected 11"));
    CHECK_THROWS_AS(excursion_arms(Course{0, undefined}, Course{1, 1}, 1, 1.0), Error);
}
