#pragma once
// Polar decomposition of a deformation gradient, inverted ones included.

#include "fascicle/base/types.hpp"

namespace fascicle::solver {

/// F = U diag(sigma) V^T with proper rotations U, V: sigma descends in size, and the last is negative when det F < 0 (the "invertible"
/// decomposition of Irving, Teran, Fedkiw 2004). R = U V^T is the rotation nearest to F, S = R^T F symmetric.
struct SignedSvd {
    Mat3 u, v;
    Vec3 sigma;
    Mat3 rotation() const { return u * v.transpose(); }
};

/// By Jacobi rotations of F^T F; U's columns are made one after the other, so that it is a rotation also where F has no rank. Finite F.
/// Deterministic, no allocation. A singular value far below the largest (< 1e-8 of it) has no digits, and needs none here.
SignedSvd signed_svd(const Mat3& f);

} // namespace fascicle::solver
