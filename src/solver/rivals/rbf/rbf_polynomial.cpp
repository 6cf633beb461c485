#include "solver/rivals/rbf/rbf_polynomial.hpp"

#include "fascicle/base/assert.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace fascicle::solver {

RbfPolynomial::RbfPolynomial(const Points& centres, bool affine) {
    FASCICLE_ASSERT(!centres.empty());
    for (const Vec3& p : centres)
        centre_ += p / double(centres.size());
    Mat3 spread = Mat3::Zero();
    for (const Vec3& p : centres)
        spread += (p - centre_) * (p - centre_).transpose() / double(centres.size());
    const double squared = spread.trace();
    if (!(squared > 0.0))
        return;
    scale_ = std::sqrt(squared);
    if (!affine)
        return;
    const Eigen::SelfAdjointEigenSolver<Mat3> eigen(spread);
    const double widest = eigen.eigenvalues()[2];
    for (int k = 2; k >= 0; --k) // eigenvalues ascend
        if (eigen.eigenvalues()[k] > flat_share * flat_share * widest)
            directions_.col(size_++ - 1) = eigen.eigenvectors().col(k);
}

} // namespace fascicle::solver
