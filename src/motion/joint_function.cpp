#include "fascicle/motion/joint_function.hpp"

#include <algorithm>
#include <utility>

namespace fascicle {
namespace {

enum class EndRule { natural, simm };

/// Unknowns of a C2 cubic spline: s_i = f''(x_i) / 2 at every knot, n >= 3. Inner rows, from equal slopes at knot i, with
/// h_i = x_{i+1} - x_i and the divided difference g_i = (y_{i+1} - y_i) / h_i:
///   h_{i-1} s_{i-1} + 2 (h_{i-1} + h_i) s_i + h_i s_{i+1} = 3 (g_i - g_{i-1}).
/// Ends: s = 0 (natural), or (s_1 - s_0) / h_0 = 3 w (simm), where w is the third divided difference of the four nearest
/// knots: the third derivative of a cubic c3 u^3 is 6 c3, and that of the piece is 2 (s_1 - s_0) / h_0. Three knots: w = 0.
/// The same spline as OpenSim's: SimmSpline::calcCoefficients (opensim-core, OpenSim/Common/SimmSpline.cpp, read in 2026) solves for
/// f''/6 with the rows above divided by 3 and ends -h c_0 + h c_1 = w h^2, and has w = 0 for three knots; two are a line, and beyond the ends
/// calcValue goes on with the slope there.
/// All rows have three entries, so elimination without pivots will do: no pivot gets smaller than its row's step lengths.
std::vector<double> half_second_derivatives(const std::vector<double>& x, const std::vector<double>& y,
                                            EndRule rule) {
    const std::size_t n = x.size();
    const auto step = [&](std::size_t i) { return x[i + 1] - x[i]; };
    const auto slope = [&](std::size_t i) { return (y[i + 1] - y[i]) / step(i); };
    const auto second = [&](std::size_t i) { return (slope(i + 1) - slope(i)) / (x[i + 2] - x[i]); };
    const auto third = [&](std::size_t i) { return (second(i + 1) - second(i)) / (x[i + 3] - x[i]); };

    std::vector<double> below(n, 0.0), pivot(n, 1.0), above(n, 0.0), s(n, 0.0);
    for (std::size_t i = 1; i + 1 < n; ++i) {
        below[i] = step(i - 1);
        pivot[i] = 2 * (step(i - 1) + step(i));
        above[i] = step(i);
        s[i] = 3 * (slope(i) - slope(i - 1));
    }
    if (rule == EndRule::simm) {
        pivot[0] = below[n - 1] = -1;
        above[0] = pivot[n - 1] = 1;
        if (n > 3) {
            s[0] = 3 * third(0) * step(0);
            s[n - 1] = 3 * third(n - 4) * step(n - 2);
        }
    }
    for (std::size_t i = 1; i < n; ++i) {
        const double factor = below[i] / pivot[i - 1];
        pivot[i] -= factor * above[i - 1];
        s[i] -= factor * s[i - 1];
    }
    s[n - 1] /= pivot[n - 1];
    for (std::size_t i = n - 1; i-- > 0;)
        s[i] = (s[i] - above[i] * s[i + 1]) / pivot[i];
    return s;
}

} // namespace

JointFunction JointFunction::constant(double value) {
    return polynomial({value});
}

JointFunction JointFunction::linear(double slope, double intercept) {
    return polynomial({slope, intercept});
}

JointFunction JointFunction::polynomial(std::vector<double> coefficients) {
    JointFunction f;
    f.powers_ = std::move(coefficients);
    return f;
}

JointFunction JointFunction::cubic(const std::vector<double>& x, const std::vector<double>& y,
                                   const std::vector<double>& half_second) {
    if (x.size() < 2)
        return constant(y.empty() ? 0.0 : y.front());
    JointFunction f;
    f.knots_ = x;
    for (std::size_t i = 0; i + 1 < x.size(); ++i) {
        const double h = x[i + 1] - x[i], s0 = half_second[i], s1 = half_second[i + 1];
        f.pieces_.push_back({y[i], (y[i + 1] - y[i]) / h - h * (2 * s0 + s1) / 3, s0, (s1 - s0) / (3 * h)});
    }
    return f;
}

JointFunction JointFunction::simm_spline(const std::vector<double>& x, const std::vector<double>& y) {
    return cubic(x, y,
                 x.size() < 3 ? std::vector<double>(x.size(), 0.0)
                              : half_second_derivatives(x, y, EndRule::simm));
}

JointFunction JointFunction::natural_cubic_spline(const std::vector<double>& x,
                                                  const std::vector<double>& y) {
    return cubic(x, y,
                 x.size() < 3 ? std::vector<double>(x.size(), 0.0)
                              : half_second_derivatives(x, y, EndRule::natural));
}

JointFunction JointFunction::piecewise_linear(const std::vector<double>& x, const std::vector<double>& y) {
    return cubic(x, y, std::vector<double>(x.size(), 0.0));
}

JointFunction JointFunction::scaled(double factor) const {
    JointFunction f = *this;
    for (double& c : f.powers_)
        c *= factor;
    for (Piece& piece : f.pieces_)
        for (double& c : piece)
            c *= factor;
    return f;
}

std::size_t JointFunction::piece_of(double x) const {
    const auto inner_end = knots_.end() - 1;
    const auto next = std::upper_bound(knots_.begin() + 1, inner_end, x);
    return static_cast<std::size_t>(next - knots_.begin()) - 1;
}

double JointFunction::value(double x) const {
    if (knots_.empty()) {
        double sum = 0;
        for (const double c : powers_)
            sum = sum * x + c;
        return sum;
    }
    const double inside = std::clamp(x, knots_.front(), knots_.back());
    const std::size_t i = piece_of(inside);
    const Piece& c = pieces_[i];
    const double u = inside - knots_[i];
    const double here = c[0] + u * (c[1] + u * (c[2] + u * c[3]));
    return x == inside ? here : here + (x - inside) * (c[1] + u * (2 * c[2] + u * 3 * c[3]));
}

double JointFunction::derivative(double x) const {
    if (knots_.empty()) {
        double sum = 0;
        for (std::size_t i = 0; i + 1 < powers_.size(); ++i)
            sum = sum * x + powers_[i] * static_cast<double>(powers_.size() - 1 - i);
        return sum;
    }
    const double inside = std::clamp(x, knots_.front(), knots_.back());
    const std::size_t i = piece_of(inside);
    const Piece& c = pieces_[i];
    const double u = inside - knots_[i];
    return c[1] + u * (2 * c[2] + u * 3 * c[3]);
}

bool JointFunction::is_constant() const {
    return knots_.empty() && powers_.size() < 2;
}

} // namespace fascicle
