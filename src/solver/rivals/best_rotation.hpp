#pragma once
// The rotation that fits two sets of vectors best (Kabsch 1976; the local step of Sorkine & Alexa 2007).

#include "fascicle/base/types.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>

namespace fascicle::solver {

/// The rotation R that maximises trace(R S), S = sum w e e'^T for pairs e -> e': S = U s V^T, R = V U^T, where det < 0 with the column
/// of the least singular value turned round. Where S has a rank below 2, that is one of several equally good rotations; never a
/// reflection.
inline Mat3 best_rotation(const Mat3& s) {
    const Eigen::JacobiSVD<Mat3> svd(s, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Mat3 u = svd.matrixU();
    const Mat3 rotation = svd.matrixV() * u.transpose();
    if (rotation.determinant() > 0.0)
        return rotation;
    u.col(2) = -u.col(2); // singular values descend
    return svd.matrixV() * u.transpose();
}

} // namespace fascicle::solver
