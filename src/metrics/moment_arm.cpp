#include "fascicle/metrics/moment_arm.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/base/error.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace fascicle {

namespace {

using Matrix = Eigen::MatrixXd;
using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Legendre polynomials up to `degree` and their derivatives at x in [-1, 1], one row a point: orthogonal over the
/// span, so the least-squares system stays well conditioned where powers of the angle do not.
void legendre(const Eigen::VectorXd& x, int degree, Matrix& values, Matrix& slopes) {
    values = Matrix::Ones(x.size(), degree + 1);
    slopes = Matrix::Zero(x.size(), degree + 1);
    for (int n = 1; n <= degree; ++n) {
        const auto& last = values.col(n - 1);
        if (n == 1)
            values.col(1) = x;
        else // n P_n = (2 n - 1) x P_(n-1) - (n - 1) P_(n-2)
            values.col(n) =
                ((2.0 * n - 1.0) * x.cwiseProduct(last) - (n - 1.0) * values.col(n - 2)) / double(n);
        slopes.col(n) = (2.0 * n - 1.0) * last; // P_n' = P_(n-2)' + (2 n - 1) P_(n-1)
        if (n > 1)
            slopes.col(n) += slopes.col(n - 2);
    }
}

/// Angles that are more than a thousandth of the span apart; the noise of nearly equal ones would be blown up.
int distinct_angles(std::span<const double> angles) {
    std::vector<double> sorted(angles.begin(), angles.end());
    std::sort(sorted.begin(), sorted.end());
    const double apart = 1e-3 * (sorted.back() - sorted.front());
    int count = 1;
    double last = sorted.front();
    for (const double a : sorted)
        if (a - last > apart) {
            ++count;
            last = a;
        }
    return count;
}

class SpanArms {
public:
    SpanArms(const MotionSpan& span, std::span<const double> angles, std::span<const double> lengths,
             int fibres, double sign, std::span<double> arms)
        : span_(span), frames_(span.last - span.first + 1), sign_(sign),
          angles_(angles.subspan(span.first, frames_)),
          lengths_(lengths.data() + span.first * static_cast<std::size_t>(fibres), Eigen::Index(frames_),
                   fibres),
          arms_(arms.data() + span.first * static_cast<std::size_t>(fibres), Eigen::Index(frames_), fibres) {}

    void polynomial(int degree) {
        degree = std::min(degree, distinct_angles(angles_) - 1);
        const auto [least, most] = std::minmax_element(angles_.begin(), angles_.end());
        const double middle = 0.5 * (*least + *most), half = 0.5 * (*most - *least);
        const Eigen::VectorXd x =
            (Eigen::Map<const Eigen::VectorXd>(angles_.data(), Eigen::Index(frames_)).array() - middle) /
            half;
        Matrix values, slopes;
        legendre(x, degree, values, slopes);
        const Matrix coefficients = values.colPivHouseholderQr().solve(Matrix(lengths_));
        arms_ = (-sign_ / half) * (slopes * coefficients);
    }

    void central_difference(double step) {
        for (std::size_t i = 0; i < frames_; ++i) {
            const auto nodes = nodes_at(i, step);
            if (!nodes) {
                polynomial(2); // too short for a step: one parabola for all of it
                return;
            }
            // Derivative at angle a of the parabola through the three: sum_m L_m w_m, w_m = (2 a - sum of the other
            // two angles) / product of the differences to them.
            const double a = angles_[i];
            arms_.row(Eigen::Index(i)).setZero();
            for (std::size_t m = 0; m < 3; ++m) {
                const double here = angles_[(*nodes)[m]], b = angles_[(*nodes)[(m + 1) % 3]],
                             c = angles_[(*nodes)[(m + 2) % 3]];
                const double weight = (2.0 * a - b - c) / ((here - b) * (here - c));
                arms_.row(Eigen::Index(i)) -= sign_ * weight * lengths_.row(Eigen::Index((*nodes)[m]));
            }
        }
    }

private:
    using Nodes = std::array<std::size_t, 3>;

    /// Nearest frame at least `step` away from frame i, going by `stride` frames.
    std::optional<std::size_t> away(std::size_t i, int stride, double step) const {
        const double reach = step * (1.0 - 1e-9); // frames exactly a step apart count
        for (auto k = std::ptrdiff_t(i) + stride; k >= 0 && k < std::ptrdiff_t(frames_); k += stride)
            if (std::abs(angles_[std::size_t(k)] - angles_[i]) >= reach)
                return std::size_t(k);
        return std::nullopt;
    }

    std::optional<Nodes> nodes_at(std::size_t i, double step) const {
        const auto before = away(i, -1, step), after = away(i, 1, step);
        if (before && after)
            return Nodes{*before, i, *after};
        for (const auto& [near, stride] : {std::pair{before, -1}, std::pair{after, 1}})
            if (near)
                if (const auto far = away(*near, stride, step))
                    return Nodes{i, *near, *far};
        return std::nullopt;
    }

    MotionSpan span_;
    std::size_t frames_;
    double sign_;
    std::span<const double> angles_;
    Eigen::Map<const Rows> lengths_;
    Eigen::Map<Rows> arms_;
};

} // namespace

void update_arms(const std::vector<MotionSpan>& spans, std::size_t from_span,
                 std::span<const double> angles_rad, std::span<const double> lengths, int fibres, double sign,
                 const ArmOptions& options, std::span<double> arms) {
    FASCICLE_ASSERT(fibres >= 0 && lengths.size() == angles_rad.size() * static_cast<std::size_t>(fibres));
    FASCICLE_ASSERT(arms.size() == lengths.size());
    FASCICLE_ASSERT(options.degree >= 1 && options.degree <= 8 && options.step_rad > 0.0);
    if (fibres == 0)
        return;
    const auto row = [&](std::size_t k) { return arms.begin() + std::ptrdiff_t(k) * fibres; };
    const auto hold = [&](std::size_t begin, std::size_t end, std::size_t from) {
        for (std::size_t k = begin; k < end; ++k)
            std::copy_n(row(from), fibres, row(k));
    };
    std::vector<double> kept;
    for (std::size_t s = from_span; s < spans.size(); ++s) {
        const MotionSpan& span = spans[s];
        const bool shared = s > 0 && spans[s - 1].last == span.first;
        if (shared)
            kept.assign(row(span.first), row(span.first + 1));
        SpanArms part(span, angles_rad, lengths, fibres, sign, arms);
        if (options.method == ArmMethod::polynomial)
            part.polynomial(options.degree);
        else
            part.central_difference(options.step_rad);
        if (shared) // belongs to the span before
            std::copy(kept.begin(), kept.end(), row(span.first));
        if (s == 0)
            hold(0, span.first, span.first);
    }
    // Where the angle stands still the span before has the word, up to the frame where the next begins, that one too.
    for (std::size_t s = from_span > 0 ? from_span - 1 : 0; s < spans.size(); ++s)
        hold(spans[s].last + 1, s + 1 < spans.size() ? spans[s + 1].first + 1 : angles_rad.size(),
             spans[s].last);
}

std::vector<double> excursion_arms(std::span<const double> angles_rad, std::span<const double> lengths,
                                   int fibres, double sign, const ArmOptions& options) {
    const std::size_t frames = angles_rad.size();
    if (fibres < 0 || lengths.size() != frames * static_cast<std::size_t>(fibres))
        throw_error("moment arms", std::to_string(lengths.size()) + " fibre lengths",
                    std::to_string(frames) + " frames of " + std::to_string(fibres) + " fibres");
    std::vector<double> arms(lengths.size(), std::numeric_limits<double>::quiet_NaN());
    update_arms(motion_spans(angles_rad), 0, angles_rad, lengths, fibres, sign, options, arms);
    return arms;
}

double line_arm(std::span<const Vec3> fibre, FibreEnd moving_end, const Hinge& hinge, double sign) {
    const Vec3 axis = hinge.axis.stableNormalized();
    if (!(axis.norm() > 0.5))
        throw_error("moment arms", "the hinge has an axis without direction", "a vector that is not zero");
    const std::size_t last = fibre.size() - 1;
    const auto at = [&](std::size_t j) {
        return moving_end == FibreEnd::origin ? fibre[j] : fibre[last - j];
    };
    for (std::size_t j = 1; j <= last; ++j) // points before it coincide with the end
        if (const Vec3 pull = at(j) - at(0); pull.squaredNorm() > 0.0)
            return sign * axis.dot((at(0) - hinge.centre).cross(pull.stableNormalized()));
    return std::numeric_limits<double>::quiet_NaN();
}

std::vector<double> line_arms(const FibreSet& fibres, FibreEnd moving_end, const Hinge& hinge, double sign) {
    std::vector<double> arms;
    for (int f = 0; f < fibres.count; ++f)
        arms.push_back(line_arm(fibres.fibre(f), moving_end, hinge, sign));
    return arms;
}

} // namespace fascicle
