#include "fascicle/motion/joint_function.hpp"

#include <Eigen/LU>
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
/// The system is diagonally dominant but for the simm ends; knots are tens, so a dense factorisation with pivots will do.
std::vector<double> half_second_derivatives(const std::vector<double>& x, const std::vector<double>& y,
                                            EndRule rule) {
    const auto n = static_cast<Eigen::Index>(x.size());
    const auto at = [](const std::vector<double>& v, Eigen::Index i) {
        return v[static_cast<std::size_t>(i)];
    };
    const auto step = [&](Eigen::Index i) { return at(x, i + 1) - at(x, i); };
    const auto slope = [&](Eigen::Index i) { return (at(y, i + 1) - at(y, i)) / step(i); };
    const auto second = [&](Eigen::Index i) {
        return (slope(i + 1) - slope(i)) / (at(x, i + 2) - at(x, i));
    };
    const auto third = [&](Eigen::Index i) { return (second(i + 1) - second(i)) / (at(x, i + 3) - at(x, i)); };

    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n);
    Eigen::VectorXd b = Eigen::VectorXd::Zero(n);
    for (Eigen::Index i = 1; i + 1 < n; ++i) {
        a(i, i - 1) = step(i - 1);
        a(i, i) = 2 * (step(i - 1) + step(i));
        a(i, i + 1) = step(i);
        b(i) = 3 * (slope(i) - slope(i - 1));
    }
    if (rule == EndRule::natural) {
        a(0, 0) = a(n - 1, n - 1) = 1;
    } else {
        a(0, 0) = a(n - 1, n - 2) = -1;
        a(0, 1) = a(n - 1, n - 1) = 1;
        if (n > 3) {
            b(0) = 3 * third(0) * step(0);
            b(n - 1) = 3 * third(n - 4) * step(n - 2);
        }
    }
    const Eigen::VectorXd s = a.partialPivLu().solve(b);
    return {s.data(), s.data() + n};
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

JointFunction JointFunction::natural_cubic_spline(const std::vector<double>& x, const std::vector<double>& y) {
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
