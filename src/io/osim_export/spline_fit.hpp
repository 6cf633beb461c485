#pragma once
// SimmSplines by least squares. A spline is linear in its values at the knots, so one matrix serves all that share knots and places.

#include <Eigen/Core>
#include <Eigen/QR>
#include <span>
#include <vector>

namespace fascicle::io {

/// M x n: column i is, at each place, the SimmSpline through 1 at knot i and 0 at the others (JointFunction::simm_spline).
Eigen::MatrixXd spline_matrix(const std::vector<double>& knots, std::span<const double> places);

/// Knots and the matrix that fits values at given places.
class SplineFit {
public:
    /// count >= 2 knots, evenly spaced from the first place to the last. places: ascending, at least `count`.
    SplineFit(std::size_t count, const std::vector<double>& places);

    const std::vector<double>& knots() const { return knots_; }
    const Eigen::MatrixXd& matrix() const { return matrix_; } ///< at the places
    /// K x C samples at the places -> n x C values at the knots, least squares.
    Eigen::MatrixXd fit(const Eigen::MatrixXd& samples) const { return solver_.solve(samples); }

private:
    std::vector<double> knots_;
    Eigen::MatrixXd matrix_;
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver_;
};

/// What the length of a fibre shall be: a polynomial of degree 10 or less in q. Lengths jitter from frame to frame by more than their
/// slope may, and moment arms come from a polynomial of degree 4 through all of them (fibres.csv), so neither can be followed alone.
///   P(q) = c_0 p_0 + sum_(n = 1..4) l_n p_n(q) + sum_(n > 4) c_n p_n(q),
/// p_n: polynomials of degree n that are orthonormal over the frames, l_n = sum_k p_n(q_k) L_k. So the polynomial of degree 4 through P at
/// the frames has the same slope as that through L: arms by excursion are the same whatever the c_n are. These make
///   sum_k u_k (P(q_k) - L_k)^2 + v_k (P'(q_k) + r_k)^2 / s^2
/// least, with weights that are raised round by round (Lawson 1961) where the errors are largest, until none is above
/// 0.8 `tolerance`, forty rounds at most. Where the lengths stay further off than 0.95 of it, s goes up from 1 by a quarter each
/// time, to 8: lengths come first.
class LengthTarget {
public:
    /// places ascending; lengths and arms in metres, tolerance too.
    LengthTarget(std::span<const double> places, std::span<const double> lengths,
                 std::span<const double> arms, double tolerance);
    double length(double q) const;

private:
    double middle_ = 0, half_ = 1;
    Eigen::VectorXd coefficients_; ///< of Chebyshev polynomials in (q - middle) / half
};

} // namespace fascicle::io
