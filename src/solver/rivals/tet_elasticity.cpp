#include "solver/rivals/tet_elasticity.hpp"

#include "solver/rivals/polar.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace fascicle::solver {

TetMaterial material_from(double young, double poisson, double fibre) {
    return {young / (2.0 * (1.0 + poisson)), young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson)),
            fibre};
}

TetShape tet_shape(const std::array<Vec3, 4>& nodes, double weight, const Vec3& fibre) {
    Mat3 edges;
    edges << nodes[1] - nodes[0], nodes[2] - nodes[0], nodes[3] - nodes[0];
    const Mat3 inverse = edges.inverse(); // rows are the gradients of the shape functions 1 to 3
    TetShape shape;
    shape.gradients[0].setZero();
    for (int i = 0; i < 3; ++i) {
        shape.gradients[static_cast<std::size_t>(i) + 1] = inverse.row(i).transpose();
        shape.gradients[0] -= inverse.row(i).transpose();
    }
    shape.volume = weight * edges.determinant() / 6.0;
    shape.fibre = fibre;
    return shape;
}

Mat3 deformation_gradient(const TetShape& shape, const std::array<Vec3, 4>& x) {
    // From differences: the gradients sum to zero, positions are far from the origin.
    Mat3 f = (x[1] - x[0]) * shape.gradients[1].transpose();
    f += (x[2] - x[0]) * shape.gradients[2].transpose();
    f += (x[3] - x[0]) * shape.gradients[3].transpose();
    return f;
}

Mat3 cofactor(const Mat3& f) {
    Mat3 c;
    c << f.col(1).cross(f.col(2)), f.col(2).cross(f.col(0)), f.col(0).cross(f.col(1));
    return c;
}

double energy_density(const TetMaterial& material, const Vec3& fibre, const Mat3& f) {
    const Vec3 sigma = signed_svd(f).sigma;
    const double growth = sigma.prod() - 1.0;
    double energy =
        material.mu * (sigma - Vec3::Ones()).squaredNorm() + 0.5 * material.lambda * growth * growth;
    if (material.fibre > 0.0 && !fibre.isZero(0.0)) {
        const double over = std::max(0.0, (f * fibre).norm() - 1.0);
        energy += 0.5 * material.fibre * over * over;
    }
    return energy;
}

Mat3 first_piola(const TetMaterial& material, const Vec3& fibre, const Mat3& f, double pressure) {
    const SignedSvd svd = signed_svd(f);
    Mat3 p = 2.0 * material.mu * (f - svd.rotation()) +
             (material.lambda * (svd.sigma.prod() - 1.0) + pressure) * cofactor(f);
    if (material.fibre > 0.0 && !fibre.isZero(0.0)) {
        const Vec3 d = f * fibre;
        if (const double l = d.norm(); l > 1.0)
            p += material.fibre * (l - 1.0) / l * d * fibre.transpose();
    }
    return p;
}

std::array<Vec3, 4> tet_gradient(const TetMaterial& material, const TetShape& shape, const Mat3& f,
                                 double pressure) {
    const Mat3 p = shape.volume * first_piola(material, shape.fibre, f, pressure);
    std::array<Vec3, 4> gradient;
    for (std::size_t i = 0; i < 4; ++i)
        gradient[i] = p * shape.gradients[i];
    return gradient;
}

Mat12 tet_stiffness(const TetMaterial& material, const TetShape& shape, const Mat3& f, bool definite,
                    double pressure) {
    const SignedSvd svd = signed_svd(f);
    const Vec3& sigma = svd.sigma;
    const double mu = material.mu, swell = material.lambda * (sigma.prod() - 1.0) + pressure;
    using Mat34 = Eigen::Matrix<double, 3, 4>;
    using Vec12 = Eigen::Matrix<double, 12, 1>;
    Mat34 g;
    for (int i = 0; i < 4; ++i)
        g.col(i) = shape.gradients[static_cast<std::size_t>(i)];
    const Eigen::Matrix4d products = g.transpose() * g;
    Mat12 k = Mat12::Zero();
    const auto add = [&](const Mat34& columns, double factor) { // factor (q : dF)^2, columns = q g_i
        const Eigen::Map<const Vec12> c(columns.data());
        k.noalias() += (factor * c) * c.transpose();
    };
    const auto raised = [&](double extra) { return definite ? std::max(extra, -2.0 * mu) : extra; };
    const Mat34 local = svd.v.transpose() * g;
    for (int axis = 0; axis < 3; ++axis) {
        const int i = (axis + 1) % 3, j = (axis + 2) % 3;
        double sum = sigma[i] + sigma[j];
        if (definite)
            sum = std::max(sum, 0.05); // a flattened tetrahedron turns easily; forces stay the true ones
        Mat34 turned = Mat34::Zero();  // [e_axis]x local
        turned.row(j) = local.row(i);
        turned.row(i) = -local.row(j);
        add(svd.u * turned, 0.5 * raised(swell * sigma[axis] - 4.0 * mu / sum));
        turned.row(i) = local.row(j);
        add(svd.u * turned, 0.5 * raised(-swell * sigma[axis]));
    }
    const Vec3 areas(sigma[1] * sigma[2], sigma[2] * sigma[0], sigma[0] * sigma[1]);
    Mat3 pairs;
    pairs << 0, sigma[2], sigma[1], sigma[2], 0, sigma[0], sigma[1], sigma[0], 0;
    Mat3 stretch = swell * pairs + material.lambda * areas * areas.transpose();
    if (definite) {
        const Eigen::SelfAdjointEigenSolver<Mat3> eigen(stretch);
        stretch = eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(-2.0 * mu).asDiagonal() *
                  eigen.eigenvectors().transpose();
    }
    Eigen::Matrix<double, 12, 3> along_axes;
    for (int axis = 0; axis < 3; ++axis) {
        const Mat34 columns = svd.u.col(axis) * local.row(axis);
        along_axes.col(axis) = Eigen::Map<const Vec12>(columns.data());
    }
    k.noalias() += along_axes * stretch * along_axes.transpose();
    Mat3 fibre_block = Mat3::Zero();
    Eigen::Vector4d along = Eigen::Vector4d::Zero();
    if (material.fibre > 0.0 && !shape.fibre.isZero(0.0)) {
        const Vec3 d = f * shape.fibre;
        if (const double l = d.norm(); l > 1.0) {
            const Vec3 n = d / l;
            along = g.transpose() * shape.fibre;
            fibre_block = material.fibre *
                          (n * n.transpose() + (1.0 - 1.0 / l) * (Mat3::Identity() - n * n.transpose()));
        }
    }
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
            k.block<3, 3>(3 * i, 3 * j) +=
                2.0 * mu * products(i, j) * Mat3::Identity() + along[i] * along[j] * fibre_block;
    return shape.volume * k;
}

Mat3 active_inverse(const Vec3& fibre, double s) {
    const Mat3 along = fibre * fibre.transpose();
    return along / s + std::sqrt(s) * (Mat3::Identity() - along);
}

} // namespace fascicle::solver
