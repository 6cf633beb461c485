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

/// What the length of a fibre shall be: a polynomial P(q), degree 8 or less, as near to the lengths L_k as -P' to the moment arms r_k,
///   sum_k u_k (P(q_k) - L_k)^2 + v_k (P'(q_k) + r_k)^2 -> min,
/// where the weights are raised round by round (Lawson 1961) where the errors are largest, until no error is above
/// 0.8 `tolerance`, twelve rounds at most.
/// Lengths of frames jitter by more than a tolerance of moment arms allows, and moment arms are known from a polynomial fit
/// (fibres.csv), so neither can be followed alone.
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
