#include "io/osim_export/spline_fit.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/motion/joint_function.hpp"

#include <algorithm>
#include <cmath>

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

LengthTarget::LengthTarget(std::span<const double> places, std::span<const double> lengths,
                           std::span<const double> arms, double tolerance) {
    const auto count = Eigen::Index(places.size());
    const Eigen::Index degree = std::min<Eigen::Index>(8, count - 1);
    middle_ = 0.5 * (places.front() + places.back());
    half_ = std::max(0.5 * (places.back() - places.front()), 1e-12);
    Eigen::MatrixXd rows(2 * count, degree + 1);
    Eigen::VectorXd wanted(2 * count);
    for (Eigen::Index k = 0; k < count; ++k) {
        Eigen::RowVectorXd values(degree + 1), slopes(degree + 1);
        chebyshev((places[std::size_t(k)] - middle_) / half_, values, slopes);
        rows.row(k) = values;
        rows.row(count + k) = slopes / -half_;
        wanted[k] = lengths[std::size_t(k)];
        wanted[count + k] = arms[std::size_t(k)];
    }
    Eigen::VectorXd weights = Eigen::VectorXd::Ones(2 * count);
    double best = std::numeric_limits<double>::infinity();
    for (int round = 0; round < 12 && best > 0.8 * tolerance; ++round) {
        const Eigen::VectorXd root = weights.cwiseSqrt();
        const Eigen::VectorXd c =
            (root.asDiagonal() * rows).colPivHouseholderQr().solve(root.cwiseProduct(wanted));
        const Eigen::VectorXd errors = (rows * c - wanted).cwiseAbs();
        const double largest = errors.maxCoeff();
        if (largest < best)
            best = largest, coefficients_ = c;
        if (!(largest > 0))
            break;
        weights = weights.cwiseProduct((errors.array() / largest + 0.05).matrix());
        weights /= weights.mean();
    }
}

double LengthTarget::length(double q) const {
    Eigen::RowVectorXd values(coefficients_.size()), slopes(coefficients_.size());
    chebyshev((q - middle_) / half_, values, slopes);
    return values.dot(coefficients_);
}

} // namespace fascicle::io
