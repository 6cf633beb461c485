#pragma once
// Interpolation in space by radial basis functions with an affine part, factored once for its centres.
//   u(x) = sum_i c_i psi(|x - x_i| / s) + a . p(x),  sum_i c_i p(x_i) = 0
// psi(r) = -r or r^3: both are conditionally positive definite with the affine side condition (Wendland 2005, ch. 8), so the system
//   [Psi P; P^T 0] [c; a] = [f; g]
// is solved on the null space of P^T by Cholesky: P = Q R, c = Q_1 R^-T g + Q_2 y, (Q_2^T Psi Q_2) y = Q_2^T (f - Psi Q_1 R^-T g),
// R a = Q_1^T (f - Psi c). The sign of psi goes into c. p, s: RbfPolynomial; centres that it finds flat get psi = -r, which needs the
// constant alone.

#include "solver/rivals/rbf/rbf_polynomial.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <span>

namespace fascicle::solver {

enum class RbfKernel { linear, cubic };

using RbfMatrix = Eigen::MatrixXd;

class RbfField {
public:
    /// N >= 1 different points. affine: false has only the constant, and psi = -r. Throws Error when the points are not different
    /// enough for a factor.
    RbfField(Points centres, RbfKernel kernel, bool affine = true);

    const Points& centres() const { return centres_; }
    const RbfPolynomial& polynomial() const { return polynomial_; }
    RbfKernel kernel() const { return kernel_; }
    Eigen::Index size() const { return static_cast<Eigen::Index>(centres_.size()) + polynomial_.size(); }

    double psi(double squared_distance) const;
    /// The column [psi(x - x_i); p(x)], size() numbers.
    void column(const Vec3& x, Eigen::Ref<Eigen::VectorXd> out) const;
    /// size() x k, [c; a] for right sides [f; g].
    RbfMatrix solve(const RbfMatrix& right) const;
    std::size_t bytes() const;

private:
    Points centres_;
    RbfPolynomial polynomial_;
    RbfKernel kernel_;
    Eigen::Matrix3Xd places_;
    RbfMatrix psi_; ///< N x N
    Eigen::HouseholderQR<RbfMatrix> polynomials_;
    Eigen::LLT<RbfMatrix> factor_; ///< of Q_2^T Psi Q_2
};

/// Values at `points`: k x points. coefficients: (size() + M) x k of the field's columns and of M more centres.
void evaluate(const RbfField& field, const Points& more, const RbfMatrix& coefficients,
              std::span<const Vec3> points, int threads, RbfMatrix& values);

} // namespace fascicle::solver
