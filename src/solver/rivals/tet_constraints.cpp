#include "solver/rivals/tet_constraints.hpp"

#include "solver/rivals/polar.hpp"

#include <cmath>

namespace fascicle::solver {

TetConstraint volume_change(const TetShape& shape, const TetPoints& x) {
    const Mat3 f = deformation_gradient(shape, x);
    const Mat3 areas = cofactor(f);
    TetConstraint c;
    c.value = f.col(0).dot(areas.col(0)) - 1.0;
    for (std::size_t i = 0; i < 4; ++i)
        c.gradient[i] = areas * shape.gradients[i];
    return c;
}

TetConstraint distortion(const TetShape& shape, const TetPoints& x) {
    const Mat3 f = deformation_gradient(shape, x);
    const Mat3 off = f - signed_svd(f).rotation();
    TetConstraint c;
    c.value = off.norm();
    for (std::size_t i = 0; i < 4; ++i)
        c.gradient[i] = c.value > 0.0 ? Vec3(off * shape.gradients[i] / c.value) : Vec3(Vec3::Zero());
    return c;
}

TetConstraint fibre_length(const TetShape& shape, const TetPoints& x) {
    TetConstraint c;
    c.gradient.fill(Vec3::Zero());
    const Vec3 d = deformation_gradient(shape, x) * shape.fibre;
    const double l = d.norm();
    if (!(l > 1.0)) // without fibres l is 0
        return c;
    c.value = l - 1.0;
    for (std::size_t i = 0; i < 4; ++i)
        c.gradient[i] = shape.fibre.dot(shape.gradients[i]) / l * d;
    return c;
}

double tet_energy(const TetMaterial& material, const TetShape& shape, const TetPoints& x) {
    const double v = volume_change(shape, x).value, d = distortion(shape, x).value;
    const double f = fibre_length(shape, x).value;
    return shape.volume *
           (material.mu * d * d + 0.5 * material.lambda * v * v + 0.5 * material.fibre * f * f);
}

namespace {

/// stiffness: V h^2 times that of the energy 1/2 stiffness C^2.
void project(const TetConstraint& c, double stiffness, const std::array<double, 4>& w, TetPoints& x) {
    double sum = 0.0;
    for (std::size_t i = 0; i < 4; ++i)
        sum += w[i] * c.gradient[i].squaredNorm();
    if (c.value == 0.0 || !(sum > 0.0) || !(stiffness > 0.0))
        return;
    const double step = -c.value / (sum + 1.0 / stiffness);
    for (std::size_t i = 0; i < 4; ++i)
        x[i] += w[i] * step * c.gradient[i];
}

} // namespace

void project_tet(const TetMaterial& material, const TetShape& shape, TetPoints& x,
                 const std::array<double, 4>& inverse_mass, double h, double scale) {
    // Gradients and volume are per unit of x; stiffness V in kPa mm^3, gradients 1/mm.
    const double weight = shape.volume * scale * scale * scale * h * h;
    std::array<double, 4> w = inverse_mass;
    for (double& v : w)
        v /= scale * scale;
    project(distortion(shape, x), 2.0 * material.mu * weight, w, x);
    project(fibre_length(shape, x), material.fibre * weight, w, x);
    project(volume_change(shape, x), material.lambda * weight, w, x);
}

void project_point(TetPoints& x, const std::array<double, 4>& weights, const Vec3& target,
                   const std::array<double, 4>& inverse_mass) {
    Vec3 off = target;
    double sum = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
        off -= weights[i] * x[i];
        sum += inverse_mass[i] * weights[i] * weights[i];
    }
    if (!(sum > 0.0))
        return;
    for (std::size_t i = 0; i < 4; ++i)
        x[i] += inverse_mass[i] * weights[i] / sum * off;
}

} // namespace fascicle::solver
