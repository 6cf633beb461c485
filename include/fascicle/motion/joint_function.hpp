#pragma once
// Functions of one variable that musculoskeletal models use: how far a joint moves, where a moving point lies.

#include <array>
#include <vector>

namespace fascicle {

/// A function of one number. Units are the caller's; x in radians or metres for joints. Immutable after it is made,
/// calls allocate nothing and may run on several threads.
///
/// Piecewise functions go on outside of their knots with the value and slope of the end, as OpenSim does.
class JointFunction {
public:
    /// 0 everywhere.
    JointFunction() = default;

    static JointFunction constant(double value);
    /// slope x + intercept.
    static JointFunction linear(double slope, double intercept);
    /// coefficients[0] x^n + ... + coefficients[n]; the highest power first. None: 0.
    static JointFunction polynomial(std::vector<double> coefficients);
    /// Cubic spline as SIMM and OpenSim make it: C2, third derivative at each end equal to that of the cubic through the
    /// four nearest knots (Forsythe, Malcolm & Moler 1977, "Computer Methods for Mathematical Computations", ch. 4);
    /// three knots: third derivative 0 at both ends; two: a line. One knot: a constant.
    /// x strictly ascending, as many as y, at least one: the caller checks. The same holds for the other two.
    static JointFunction simm_spline(const std::vector<double>& x, const std::vector<double>& y);
    /// Cubic spline, C2, second derivative 0 at both ends.
    static JointFunction natural_cubic_spline(const std::vector<double>& x, const std::vector<double>& y);
    static JointFunction piecewise_linear(const std::vector<double>& x, const std::vector<double>& y);

    /// factor times this function.
    JointFunction scaled(double factor) const;

    double value(double x) const;
    /// First derivative; at a corner of a piecewise linear function that of the piece to its right.
    double derivative(double x) const;
    bool is_constant() const;

private:
    /// Piece i holds for x in [knots_[i], knots_[i + 1]]: c0 + u (c1 + u (c2 + u c3)), u = x - knots_[i].
    using Piece = std::array<double, 4>;
    static JointFunction cubic(const std::vector<double>& x, const std::vector<double>& y,
                               const std::vector<double>& half_second);
    std::size_t piece_of(double x) const;

    std::vector<double> knots_; ///< empty: a polynomial
    std::vector<Piece> pieces_;
    std::vector<double> powers_; ///< of the polynomial, highest first
};

} // namespace fascicle
