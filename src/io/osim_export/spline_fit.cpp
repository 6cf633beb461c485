#include "io/osim_export/spline_fit.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/motion/joint_function.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fascicle::io {
namespace {

std::vector<double> even_knots(std::size_t count, double first, double last) {
    std::vector<double> knots;
    for (std::size_t i = 0; i < count; ++i)
        knots.push_back(i + 1 == count ? last : first + (last - first) * double(i) / double(count - 1));
    return knots;
}

/// T_0 .. T_degree at x, and their derivatives: T_n = 2 x T_(n-1) - T_(n-2).
void chebyshev(double x, Eigen::Ref<Eigen::RowVectorXd> values, Eigen::Ref<Eigen::RowVectorXd> slopes) {
    values[0] = 1, slopes[0] = 0;
    if (values.size() > 1)
        values[1] = x, slopes[1] = 1;
    for (Eigen::Index n = 2; n < values.size(); ++n) {
        values[n] = 2 * x * values[n - 1] - values[n - 2];
        slopes[n] = 2 * values[n - 1] + 2 * x * slopes[n - 1] - slopes[n - 2];
    }
}

} // namespace

Eigen::MatrixXd spline_matrix(const std::vector<double>& knots, std::span<const double> places) {
    Eigen::MatrixXd matrix(Eigen::Index(places.size()), Eigen::Index(knots.size()));
    std::vector<double> unit(knots.size(), 0.0);
    for (std::size_t i = 0; i < knots.size(); ++i) {
        unit[i] = 1;
        const JointFunction spline = JointFunction::simm_spline(knots, unit);
        unit[i] = 0;
        for (std::size_t k = 0; k < places.size(); ++k)
            matrix(Eigen::Index(k), Eigen::Index(i)) = spline.value(places[k]);
    }
    return matrix;
}

SplineFit::SplineFit(std::size_t count, const std::vector<double>& places)
    : knots_(even_knots(count, places.front(), places.back())), matrix_(spline_matrix(knots_, places)),
      solver_(matrix_) {
    FASCICLE_ASSERT(count >= 2 && count <= places.size());
}

namespace {

/// Least weighted squares of rows c - wanted, with weights raised where errors are largest, until none is above `enough`: the c with the
/// smallest largest error.
Eigen::VectorXd smallest_largest_error(const Eigen::MatrixXd& rows, const Eigen::VectorXd& wanted,
                                       double enough) {
    Eigen::VectorXd weights = Eigen::VectorXd::Ones(wanted.size()), best_c;
    double best = std::numeric_limits<double>::infinity();
    for (int round = 0; round < 40 && best > enough; ++round) {
        const Eigen::VectorXd root = weights.cwiseSqrt();
        const Eigen::VectorXd c =
            (root.asDiagonal() * rows).colPivHouseholderQr().solve(root.cwiseProduct(wanted));
        const Eigen::VectorXd errors = (rows * c - wanted).cwiseAbs();
        const double largest = errors.maxCoeff();
        if (largest < best)
            best = largest, best_c = c;
        if (!(largest > 0))
            break;
        weights = weights.cwiseProduct((errors.array() / largest + 0.05).matrix());
        weights /= weights.mean();
    }
    return best_c;
}

} // namespace

LengthTarget::LengthTarget(std::span<const double> places, std::span<const double> lengths,
                           std::span<const double> arms, double tolerance) {
    const auto count = Eigen::Index(places.size());
    const Eigen::Index degree = std::min<Eigen::Index>(10, count - 1),
                       kept = std::min<Eigen::Index>(4, degree);
    middle_ = 0.5 * (places.front() + places.back());
    half_ = std::max(0.5 * (places.back() - places.front()), 1e-12);
    Eigen::MatrixXd values(count, degree + 1), slopes(count, degree + 1);
    for (Eigen::Index k = 0; k < count; ++k) {
        Eigen::RowVectorXd v(degree + 1), s(degree + 1);
        chebyshev((places[std::size_t(k)] - middle_) / half_, v, s);
        values.row(k) = v;
        slopes.row(k) = s / half_;
    }
    // values = Q U: the columns of Q are the p_n at the frames, U^-1 their coefficients.
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(values);
    const Eigen::MatrixXd inverse = qr.matrixQR()
                                        .topRows(degree + 1)
                                        .triangularView<Eigen::Upper>()
                                        .solve(Eigen::MatrixXd::Identity(degree + 1, degree + 1));
    const Eigen::MatrixXd p = values * inverse, dp = slopes * inverse;
    const Eigen::Map<const Eigen::VectorXd> l(lengths.data(), count), r(arms.data(), count);

    Eigen::VectorXd c = p.transpose() * l;
    c[0] = 0;
    c.tail(degree - kept).setZero();
    const Eigen::Index open = 1 + degree - kept;
    Eigen::MatrixXd rows(2 * count, open);
    rows << p.col(0), p.rightCols(degree - kept), -dp.col(0), -dp.rightCols(degree - kept);
    Eigen::VectorXd wanted(2 * count);
    wanted << l - p * c, r + dp * c;
    Eigen::VectorXd found;
    constexpr double step = 1.25;
    for (double s = 1; s < 8; s *= step) {
        found = smallest_largest_error(rows, wanted, 0.8 * tolerance);
        if ((rows * found - wanted).head(count).cwiseAbs().maxCoeff() <= 0.95 * tolerance)
            break;
        rows.bottomRows(count) /= step;
        wanted.tail(count) /= step;
    }
    c[0] = found[0];
    c.tail(degree - kept) = found.tail(open - 1);
    coefficients_ = inverse * c;
}

double LengthTarget::length(double q) const {
    Eigen::RowVectorXd values(coefficients_.size()), slopes(coefficients_.size());
    chebyshev((q - middle_) / half_, values, slopes);
    return values.dot(coefficients_);
}

} // namespace fascicle::io
