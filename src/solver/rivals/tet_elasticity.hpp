#pragma once
// Energy of one tetrahedron, its forces and its stiffness: corotational elasticity and fibres that resist being stretched.
// Sources: methods notes 6.4, but the volume is the true one, det F, instead of the trace (Stomakhin, Howes, Schroeder, Teran 2012,
// "Energetically consistent invertible elasticity"): the same at small strain, while a trace of zero is a third of the volume at a
// squeeze to a tenth; tangent in closed form: Smith, de Goes, Kim 2019, "Analytic eigensystems for isotropic distortion energies"; fibres: the along-fibre part of a transversely isotropic material (Blemker, Pinsky, Delp 2005) with a straight line for
// the passive curve.

#include "fascicle/base/types.hpp"

namespace fascicle::solver {

/// Lamé constants and the fibres' stiffness, all in the same unit of stress.
struct TetMaterial {
    double mu = 1, lambda = 1;
    double fibre = 0;
};

/// mu = E / (2 (1 + nu)), lambda = E nu / ((1 + nu)(1 - 2 nu)); -1 < nu < 0.5.
TetMaterial material_from(double young, double poisson, double fibre = 0.0);

/// What stays: shape gradients at rest. F = sum x_i g_i^T maps rest to now.
struct TetShape {
    std::array<Vec3, 4> gradients; ///< g_i, 1 / length; sum to 0
    double volume = 0;             ///< that counts: of the tetrahedron times its fill
    Vec3 fibre = Vec3::Zero();     ///< a, unit, at rest; zero: no fibres
};

/// nodes: positive volume. weight: fill.
TetShape tet_shape(const std::array<Vec3, 4>& nodes, double weight, const Vec3& fibre);

Mat3 deformation_gradient(const TetShape& shape, const std::array<Vec3, 4>& x);

/// Energy density per rest volume, with J = det F, l = |F a|:
///   W(F) = mu |F - R|^2 + lambda/2 (J - 1)^2 + k/2 max(0, l - 1)^2.
/// R is the nearest rotation (det R = 1), so that an inverted tetrahedron is pulled back through its flattest way. Fibres bear no
/// pressure: nothing below their rest length.
double energy_density(const TetMaterial& material, const Vec3& fibre, const Mat3& f);

/// P = dW/dF = 2 mu (F - R) + (lambda (J - 1) + pressure) cof F + k max(0, l - 1)/l F a a^T, cof F = dJ/dF; pressure: of what wants the
/// volume of many tetrahedra to change by pressure * J. Not differentiable where two singular values sum to zero
/// (far beyond inversion) and for l = 0, where the fibre term is zero.
Mat3 first_piola(const TetMaterial& material, const Vec3& fibre, const Mat3& f, double pressure = 0.0);

/// The 12 x 12 second derivative of volume * (W + pressure * J) by the nodes' positions (3 node + axis). With s the singular values,
/// c_i = s_j s_k and a = lambda (J - 1) + pressure
///   d2W = 2 mu |dF|^2 + sum_k (a s_k - 4 mu/(s_i + s_j)) (q_k : dF)^2 - a s_k (r_k : dF)^2 + d^T (lambda c c^T + a B) d + fibres,
/// q_k = U [e_k]x V^T / sqrt(2), r_k the same with both signs plus, d the diagonal of U^T dF V, B_ij = s_k off its diagonal and 0 on it.
/// definite: eigenvalues below zero are raised to zero and 1/(s_i + s_j) is bounded, for Newton's method; else the exact tangent.
using Mat12 = Eigen::Matrix<double, 12, 12>;
Mat12 tet_stiffness(const TetMaterial& material, const TetShape& shape, const Mat3& f, bool definite,
                    double pressure = 0.0);

/// dE/dx_i = volume P g_i.
std::array<Vec3, 4> tet_gradient(const TetMaterial& material, const TetShape& shape, const Mat3& f,
                                 double pressure = 0.0);

/// cof F = det(F) F^-T, the derivative of det F; finite for any F.
Mat3 cofactor(const Mat3& f);

/// Inverse of the stress-free shape of fibres that are s long: G = a a^T / s + sqrt(s) (I - a a^T), det 1 (active_strain.hpp).
/// A tetrahedron with active fibres has the energy of F G.
Mat3 active_inverse(const Vec3& fibre, double s);

} // namespace fascicle::solver
