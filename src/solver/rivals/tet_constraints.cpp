#include "solver/rivals/tet_constraints.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::solver {

TetConstraint hydrostatic(const TetShape& shape, const TetPoints& x, double gamma) {
    const Mat3 f = deformation_gradient(shape, x);
    Mat3 cofactor;
    cofactor << f.col(1).cross(f.col(2)), f.col(2).cross(f.col(0)), f.col(0).cross(f.col(1));
    TetConstraint c;
    c.value = f.col(0).dot(cofactor.col(0)) - gamma;
    for (std::size_t i = 0; i < 4; ++i)
        c.gradient[i] = cofactor * shape.gradients[i];
    return c;
}

TetConstraint deviatoric(const TetShape& shape, const TetPoints& x) {
    const Mat3 f = deformation_gradient(shape, x);
    TetConstraint c;
    c.value = f.norm();
    for (std::size_t i = 0; i < 4; ++i)
        c.gradient[i] = c.value > 0.0 ? Vec3(f * shape.gradients[i] / c.value) : Vec3(Vec3::Zero());
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

double neo_hookean_gamma(const TetMaterial& material) {
    return 1.0 + material.mu / (material.lambda + material.mu);
}

double neo_hookean_energy(const TetMaterial& material, const TetShape& shape, const TetPoints& x) {
    const double h = hydrostatic(shape, x, neo_hookean_gamma(material)).value;
    const double d = deviatoric(shape, x).value, f = fibre_length(shape, x).value;
    return 0.5 * shape.volume *
           (material.mu * d * d + (material.lambda + material.mu) * h * h + material.fibre * f * f);
}

namespace {

double product(const TetConstraint& a, const TetConstraint& b, const std::array<double, 4>& w) {
    double sum = 0.0;
    for (std::size_t i = 0; i < 4; ++i)
        sum += w[i] * a.gradient[i].dot(b.gradient[i]);
    return sum;
}

} // namespace

void project_tet(const TetMaterial& material, const TetShape& shape, TetPoints& x,
                 const std::array<double, 4>& inverse_mass, double h, double scale) {
    // Gradients and volume are per unit of x; stiffness V in kPa mm^3, gradients 1/mm.
    const double volume = shape.volume * scale * scale * scale, per = 1.0 / (volume * h * h);
    std::array<double, 4> w = inverse_mass;
    for (double& v : w)
        v /= scale * scale;
    const TetConstraint first = hydrostatic(shape, x, neo_hookean_gamma(material));
    const TetConstraint second = deviatoric(shape, x);
    const double a = product(first, first, w) + per / (material.lambda + material.mu);
    const double b = product(first, second, w), d = product(second, second, w) + per / material.mu;
    const double determinant = a * d - b * b; // > 0: a Gram matrix and something positive on its diagonal
    const double l1 = (-d * first.value + b * second.value) / determinant;
    const double l2 = (b * first.value - a * second.value) / determinant;
    if (std::isfinite(l1) && std::isfinite(l2))
        for (std::size_t i = 0; i < 4; ++i)
            x[i] += w[i] * (l1 * first.gradient[i] + l2 * second.gradient[i]);
    if (!(material.fibre > 0.0))
        return;
    const TetConstraint third = fibre_length(shape, x);
    if (!(third.value > 0.0))
        return;
    const double l3 = -third.value / (product(third, third, w) + per / material.fibre);
    for (std::size_t i = 0; i < 4; ++i)
        x[i] += w[i] * l3 * third.gradient[i];
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
