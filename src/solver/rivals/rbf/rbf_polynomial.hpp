#pragma once
// The affine part of a radial basis field, as far as a set of centres determines it.

#include "fascicle/base/types.hpp"

namespace fascicle::solver {

/// p(x) = [1, d_1 . (x - c) / s, ...]: c the centres' mean, s their root mean square distance from it, d_k those principal directions
/// in which they spread by more than `flat_share` of the widest. Four functions; three for centres in a plane, two on a line, one for
/// a point. A thin direction is left out, since a gradient along it would be noise many times enlarged. Plain numbers.
class RbfPolynomial {
public:
    static constexpr double flat_share = 1e-3;

    RbfPolynomial() = default;
    /// At least one centre. affine: false leaves all directions out.
    explicit RbfPolynomial(const Points& centres, bool affine = true);

    int size() const { return size_; }
    bool full() const { return size_ == 4; }
    const Vec3& centre() const { return centre_; }
    double scale() const { return scale_; } ///< > 0, also of a single centre
    /// Writes size() values.
    template <class Out>
    void put(const Vec3& x, Out&& out) const {
        out[0] = 1.0;
        for (int k = 1; k < size_; ++k)
            out[k] = directions_.col(k - 1).dot(x - centre_) / scale_;
    }

private:
    Vec3 centre_ = Vec3::Zero();
    Mat3 directions_ = Mat3::Identity();
    double scale_ = 1;
    int size_ = 1;
};

} // namespace fascicle::solver
