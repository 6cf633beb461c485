#pragma once
// The constraints of one tetrahedron in XPBD: volume and distortion of a neo-Hookean solid, and the length of fibres.

#include "solver/rivals/tet_elasticity.hpp"

namespace fascicle::solver {

using TetPoints = std::array<Vec3, 4>;

/// Value and its derivative by the four corners.
struct TetConstraint {
    double value = 0;
    TetPoints gradient{};
};

/// C = det F - gamma; dC/dx_i = cof(F) g_i. Macklin & Mueller 2021, "A constraint-based formulation of stable neo-Hookean materials".
TetConstraint hydrostatic(const TetShape& shape, const TetPoints& x, double gamma);
/// C = sqrt(tr(F^T F)) = |F|; dC/dx_i = F g_i / |F|, zero for F = 0. Same source.
TetConstraint deviatoric(const TetShape& shape, const TetPoints& x);
/// C = max(0, |F a| - 1), a the fibres' direction; dC/dx_i = (a . g_i) F a / |F a|. Zero without fibres and for fibres that are short.
TetConstraint fibre_length(const TetShape& shape, const TetPoints& x);

/// The energy is V (mu/2 |F|^2 + l/2 (det F - gamma)^2 + k/2 max(0, |F a| - 1)^2), l = lambda + mu, gamma = 1 + mu/l, which at small
/// strain is that of Lamé's constants mu, lambda (Smith, de Goes, Kim 2018, section 3.4) and has no stress at rest.
double neo_hookean_gamma(const TetMaterial& material);
double neo_hookean_energy(const TetMaterial& material, const TetShape& shape, const TetPoints& x);

/// One XPBD projection (multipliers start at 0 in each substep) of the first two constraints together, then of the fibres:
///   (G + A) dl = -C, dx_i = w_i sum_c dl_c dC_c/dx_i, G_cd = sum_i w_i grad_i C_c . grad_i C_d, A = diag(1 / (stiffness V h^2)).
/// Together, because at rest both are far from zero and balance each other: one after the other they would never be still.
/// w: inverse masses of the corners (kg, when stresses are in kPa, lengths in mm and h in s); scale: millimetres per unit of x.
void project_tet(const TetMaterial& material, const TetShape& shape, TetPoints& x,
                 const std::array<double, 4>& inverse_mass, double h, double scale);

/// Least motion that brings the bound point to the target: dx_i = w_i b_i / (sum w_j b_j^2) (target - sum b_j x_j), b the weights.
/// Nothing moves when no corner can.
void project_point(TetPoints& x, const std::array<double, 4>& weights, const Vec3& target,
                   const std::array<double, 4>& inverse_mass);

} // namespace fascicle::solver
