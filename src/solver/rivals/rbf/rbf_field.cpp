#include "solver/rivals/rbf/rbf_field.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/base/bytes_of.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/base/parallel.hpp"

#include <cmath>

namespace fascicle::solver {

namespace {

/// psi of all squared distances, in place. scale: 1 / s.
template <class Array>
void apply(RbfKernel kernel, double scale, Array squared) {
    if (kernel == RbfKernel::linear)
        squared = -scale * squared.sqrt();
    else
        squared = (scale * scale * scale) * squared * squared.sqrt();
}

Eigen::Matrix3Xd matrix_of(const Points& points) {
    Eigen::Matrix3Xd result(3, static_cast<Eigen::Index>(points.size()));
    for (std::size_t i = 0; i < points.size(); ++i)
        result.col(static_cast<Eigen::Index>(i)) = points[i];
    return result;
}

/// out_i = |x - places_i|^2
template <class Out>
void squared_distances(const Eigen::Matrix3Xd& places, const Vec3& x, Out&& out) {
    out = (places.row(0).array() - x.x()).square() + (places.row(1).array() - x.y()).square() +
          (places.row(2).array() - x.z()).square();
}

} // namespace

RbfField::RbfField(Points centres, RbfKernel kernel, bool affine)
    : centres_(std::move(centres)), polynomial_(centres_, affine),
      kernel_(polynomial_.full() ? kernel : RbfKernel::linear), places_(matrix_of(centres_)) {
    const auto n = static_cast<Eigen::Index>(centres_.size());
    const Eigen::Index q = polynomial_.size();
    psi_.resize(n, n);
    RbfMatrix polynomials(n, q);
    Eigen::VectorXd one(size());
    for (Eigen::Index i = 0; i < n; ++i) {
        column(centres_[static_cast<std::size_t>(i)], one);
        psi_.col(i) = one.head(n);
        polynomials.row(i) = one.tail(q).transpose();
    }
    polynomials_.compute(polynomials);
    if (n == q)
        return;
    RbfMatrix turned = psi_;
    turned.applyOnTheLeft(polynomials_.householderQ().adjoint());
    turned.applyOnTheRight(polynomials_.householderQ());
    factor_.compute(turned.bottomRightCorner(n - q, n - q));
    if (factor_.info() != Eigen::Success)
        throw_error("rbf", "the system of " + std::to_string(n) + " centres is singular",
                    "centres in different places");
}

double RbfField::psi(double squared_distance) const {
    Eigen::Array<double, 1, 1> value(squared_distance);
    apply(kernel_, 1.0 / polynomial_.scale(), value.head(1));
    return value[0];
}

void RbfField::column(const Vec3& x, Eigen::Ref<Eigen::VectorXd> out) const {
    const auto n = static_cast<Eigen::Index>(centres_.size());
    squared_distances(places_, x, out.head(n).transpose().array());
    apply(kernel_, 1.0 / polynomial_.scale(), out.head(n).array());
    polynomial_.put(x, out.tail(polynomial_.size()));
}

RbfMatrix RbfField::solve(const RbfMatrix& right) const {
    FASCICLE_ASSERT(right.rows() == size());
    const auto n = static_cast<Eigen::Index>(centres_.size());
    const Eigen::Index q = polynomial_.size();
    const auto upper = polynomials_.matrixQR().topRows(q).triangularView<Eigen::Upper>();
    RbfMatrix c = RbfMatrix::Zero(n, right.cols());
    c.topRows(q) = upper.transpose().solve(right.bottomRows(q));
    c.applyOnTheLeft(polynomials_.householderQ()); // Q_1 R^-T g
    RbfMatrix left = right.topRows(n) - psi_ * c;
    if (n > q) {
        RbfMatrix turned = left;
        turned.applyOnTheLeft(polynomials_.householderQ().adjoint());
        RbfMatrix y = RbfMatrix::Zero(n, right.cols());
        y.bottomRows(n - q) = factor_.solve(turned.bottomRows(n - q));
        y.applyOnTheLeft(polynomials_.householderQ());
        c += y;
        left -= psi_ * y;
    }
    left.applyOnTheLeft(polynomials_.householderQ().adjoint());
    RbfMatrix result(size(), right.cols());
    result.topRows(n) = c;
    result.bottomRows(q) = upper.solve(left.topRows(q));
    return result;
}

std::size_t RbfField::bytes() const {
    const auto numbers = psi_.size() + polynomials_.matrixQR().size() + factor_.matrixLLT().size();
    return 2 * bytes_of(centres_) + static_cast<std::size_t>(numbers) * sizeof(double);
}

void evaluate(const RbfField& field, const Points& more, const RbfMatrix& coefficients,
              std::span<const Vec3> points, int threads, RbfMatrix& values) {
    const auto extra = static_cast<Eigen::Index>(more.size());
    FASCICLE_ASSERT(coefficients.rows() == field.size() + extra);
    const Eigen::Matrix3Xd places = matrix_of(more);
    const double scale = 1.0 / field.polynomial().scale();
    values.resize(coefficients.cols(), static_cast<Eigen::Index>(points.size()));
    parallel_for(threads, points.size(), 32, [&](std::size_t begin, std::size_t end) {
        const auto count = static_cast<Eigen::Index>(end - begin);
        RbfMatrix columns(coefficients.rows(), count);
        for (Eigen::Index i = 0; i < count; ++i) {
            const Vec3& x = points[begin + static_cast<std::size_t>(i)];
            field.column(x, columns.col(i).head(field.size()));
            auto rest = columns.col(i).tail(extra);
            squared_distances(places, x, rest.transpose().array());
            apply(field.kernel(), scale, rest.array());
        }
        values.middleCols(static_cast<Eigen::Index>(begin), count).noalias() =
            coefficients.transpose() * columns;
    });
}

} // namespace fascicle::solver
