#include "fascicle/motion/joint_function.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace fascicle;

namespace {

const std::vector<double> uneven{-1.0, -0.7, 0.1, 0.4, 1.5, 2.0};

double cubic(double x) {
    return 2 - x + 3 * x * x - 0.5 * x * x * x;
}

std::vector<double> values_at(const std::vector<double>& x, double (*f)(double)) {
    std::vector<double> y;
    for (const double v : x)
        y.push_back(f(v));
    return y;
}

/// Value, slope and second derivative do not jump at the knots.
void check_smooth(const JointFunction& f, const std::vector<double>& x, bool second) {
    const double h = 1e-5;
    for (std::size_t i = 1; i + 1 < x.size(); ++i) {
        CHECK(f.value(x[i] - 1e-12) == Approx(f.value(x[i] + 1e-12)).margin(1e-10));
        CHECK(f.derivative(x[i] - 1e-9) == Approx(f.derivative(x[i] + 1e-9)).margin(1e-6));
        if (second)
            CHECK((f.derivative(x[i]) - f.derivative(x[i] - h)) / h ==
                  Approx((f.derivative(x[i] + h) - f.derivative(x[i])) / h).margin(1e-2));
    }
}

} // namespace

TEST_CASE("SIMM spline: a cubic comes back, ends and all", "[motion][function]") {
    // Both end conditions hold for a cubic, and the spline that fulfils them is one alone.
    const JointFunction f = JointFunction::simm_spline(uneven, values_at(uneven, cubic));
    for (double x = -1; x <= 2; x += 0.01) {
        CHECK(f.value(x) == Approx(cubic(x)).epsilon(1e-12));
        CHECK(f.derivative(x) == Approx(-1 + 6 * x - 1.5 * x * x).margin(1e-11));
    }
    // Outside it goes on straight.
    CHECK(f.value(3) == Approx(cubic(2) + (-1 + 12 - 6)));
    CHECK(f.value(-2) == Approx(cubic(-1) - (-1 - 6 - 1.5)));
    CHECK(f.derivative(5) == Approx(5));
}

TEST_CASE("SIMM spline: smooth, through its knots, third derivative at the ends of the nearest four",
          "[motion][function]") {
    const std::vector<double> y{0.3, -0.2, 0.9, 1.0, 0.1, 0.4};
    const JointFunction f = JointFunction::simm_spline(uneven, y);
    for (std::size_t i = 0; i < y.size(); ++i)
        CHECK(f.value(uneven[i]) == Approx(y[i]));
    check_smooth(f, uneven, true);
    const auto third = [&](double from, double to) { // of the piece: the slope is a parabola there
        const double h = (to - from) / 4;
        return (f.derivative(to - h) - 2 * f.derivative(from + 2 * h) + f.derivative(from + h)) / (h * h);
    };
    // Lagrange's cubic through four knots has the third derivative 6 sum y_i / prod (x_i - x_j).
    const auto lagrange = [&](std::size_t first) {
        double sum = 0;
        for (std::size_t i = first; i < first + 4; ++i) {
            double product = 1;
            for (std::size_t j = first; j < first + 4; ++j)
                product *= i == j ? 1.0 : uneven[i] - uneven[j];
            sum += y[i] / product;
        }
        return 6 * sum;
    };
    CHECK(third(uneven[0], uneven[1]) == Approx(lagrange(0)));
    CHECK(third(uneven[4], uneven[5]) == Approx(lagrange(2)));
}

TEST_CASE("SIMM spline: three knots, two, one", "[motion][function]") {
    const JointFunction three = JointFunction::simm_spline({0, 1, 3}, {0, 1, 9});
    for (double x = 0; x <= 3; x += 0.25)
        CHECK(three.value(x) == Approx(x * x)); // a parabola: third derivatives 0
    const JointFunction two = JointFunction::simm_spline({1, 3}, {5, 9});
    CHECK(two.value(2) == Approx(7));
    CHECK(two.value(0) == Approx(3));
    CHECK(two.derivative(10) == Approx(2));
    CHECK(JointFunction::simm_spline({1}, {4}).value(-7) == 4);
}

TEST_CASE("natural spline: no bend at the ends", "[motion][function]") {
    const std::vector<double> y{0.3, -0.2, 0.9, 1.0, 0.1, 0.4};
    const JointFunction f = JointFunction::natural_cubic_spline(uneven, y);
    for (std::size_t i = 0; i < y.size(); ++i)
        CHECK(f.value(uneven[i]) == Approx(y[i]));
    check_smooth(f, uneven, true);
    CHECK((f.derivative(-1 + 1e-6) - f.derivative(-1)) / 1e-6 == Approx(0).margin(1e-4));
    CHECK((f.derivative(2) - f.derivative(2 - 1e-6)) / 1e-6 == Approx(0).margin(1e-4));
    // The known natural spline of 0, 1, 0 at 0, 1, 2: 1.5 x - 0.5 x^3.
    const JointFunction hat = JointFunction::natural_cubic_spline({0, 1, 2}, {0, 1, 0});
    CHECK(hat.value(0.5) == Approx(0.6875));
    CHECK(hat.value(1.5) == Approx(0.6875));
}

TEST_CASE("piecewise lines, polynomials, factors", "[motion][function]") {
    const JointFunction lines = JointFunction::piecewise_linear({0, 1, 3}, {0, 2, 0});
    CHECK(lines.value(0.5) == Approx(1));
    CHECK(lines.value(2) == Approx(1));
    CHECK(lines.value(4) == Approx(-1));
    CHECK(lines.value(-1) == Approx(-2));
    CHECK(lines.derivative(1) == Approx(-1));
    const JointFunction p = JointFunction::polynomial({2, 0, -1, 3}); // 2 x^3 - x + 3
    CHECK(p.value(2) == 17);
    CHECK(p.derivative(2) == 23);
    CHECK(JointFunction::polynomial({}).value(4) == 0);
    CHECK(JointFunction::linear(2, 1).value(3) == 7);
    CHECK(lines.scaled(-3).value(2) == Approx(-3));
    CHECK(p.scaled(0.5).derivative(2) == 11.5);
    CHECK(JointFunction().is_constant());
    CHECK(JointFunction::constant(2).is_constant());
    CHECK_FALSE(lines.is_constant());
}
