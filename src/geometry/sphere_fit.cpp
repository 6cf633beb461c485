#include "fascicle/geometry/sphere_fit.hpp"

#include "fascicle/base/assert.hpp"

#include <Eigen/Dense>
#include <cmath>

namespace fascicle {

namespace {

using Vec4 = Eigen::Vector4d;
using Mat4 = Eigen::Matrix4d;

/// Solution of the symmetric system, or nothing when a direction is undetermined.
std::optional<Vec4> solve(const Mat4& matrix, const Vec4& right) {
    const Eigen::SelfAdjointEigenSolver<Mat4> eigen(matrix);
    if (eigen.info() != Eigen::Success || !(eigen.eigenvalues()[0] > 1e-9 * eigen.eigenvalues()[3]))
        return std::nullopt;
    return eigen.eigenvectors() *
           (eigen.eigenvectors().transpose() * right).cwiseQuotient(eigen.eigenvalues());
}

} // namespace

std::optional<SphereFit> fit_sphere(const Points& points, const std::vector<double>& weights) {
    FASCICLE_ASSERT(weights.empty() || weights.size() == points.size());
    const auto weight = [&](std::size_t i) { return weights.empty() ? 1.0 : weights[i]; };
    double total = 0.0;
    Vec3 mean = Vec3::Zero();
    for (std::size_t i = 0; i < points.size(); ++i) {
        total += weight(i);
        mean += weight(i) * points[i];
    }
    if (points.size() < 4 || !(total > 0.0))
        return std::nullopt;
    mean /= total;
    double spread = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i)
        spread += weight(i) * (points[i] - mean).squaredNorm();
    spread = std::sqrt(spread / total);
    if (!(spread > 0.0))
        return std::nullopt;
    // In units of the spread about the mean, so that the conditioning says something.
    Mat4 matrix = Mat4::Zero();
    Vec4 right = Vec4::Zero();
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec3 y = (points[i] - mean) / spread;
        const Vec4 row(y.x(), y.y(), y.z(), 1.0);
        matrix += weight(i) / total * row * row.transpose();
        right += weight(i) / total * y.squaredNorm() * row;
    }
    const std::optional<Vec4> start = solve(matrix, right);
    if (!start)
        return std::nullopt;
    Vec3 centre = 0.5 * start->head<3>();
    double radius = std::sqrt(std::max(0.0, (*start)[3] + centre.squaredNorm()));
    double error = 0.0;
    for (int iteration = 0; iteration < 50; ++iteration) {
        matrix.setZero();
        right.setZero();
        error = 0.0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Vec3 from = (points[i] - mean) / spread - centre;
            const double length = from.norm();
            const double residual = length - radius;
            const Vec3 along = length > 0.0 ? Vec3(from / length) : Vec3::Zero();
            const Vec4 row(along.x(), along.y(), along.z(), 1.0);
            matrix += weight(i) / total * row * row.transpose();
            right += weight(i) / total * residual * row;
            error += weight(i) / total * residual * residual;
        }
        const std::optional<Vec4> change = solve(matrix, right);
        if (!change || !change->allFinite())
            return std::nullopt;
        centre += change->head<3>();
        radius += (*change)[3];
        if (change->norm() < 1e-12)
            break;
    }
    if (!(radius > 0.0) || !(radius < 1e6))
        return std::nullopt;
    return SphereFit{{mean + spread * centre, spread * radius}, spread * std::sqrt(error)};
}

} // namespace fascicle
