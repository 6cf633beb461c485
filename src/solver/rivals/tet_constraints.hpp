#pragma once
// The constraints of one tetrahedron in XPBD: volume, distortion, and the length of fibres. Sources: XPBD: Macklin, Mueller, Chentanez
// 2016; one energy and one volume constraint a tetrahedron: methods notes 6.4.

#include "solver/rivals/tet_elasticity.hpp"

namespace fascicle::solver {

using TetPoints = std::array<Vec3, 4>;

/// Value and its derivative by the four corners.
struct TetConstraint {
    double value = 0;
    TetPoints gradient{};
};

/// C = det F - 1; dC/dx_i = cof(F) g_i.
TetConstraint volume_change(const TetShape& shape, const TetPoints& x);
/// C = |F - R|, R the rotation nearest to F; dC/dx_i = (F - R) g_i / C, zero at C = 0.
TetConstraint distortion(const TetShape& shape, const TetPoints& x);
/// C = max(0, |F a| - 1), a the fibres' direction; dC/dx_i = (a . g_i) F a / |F a|. Zero without fibres and for fibres that are short.
TetConstraint fibre_length(const TetShape& shape, const TetPoints& x);

/// The energy is V (mu |F - R|^2 + lambda/2 (det F - 1)^2 + k/2 max(0, |F a| - 1)^2): at small strain that of Lamé's constants.
double tet_energy(const TetMaterial& material, const TetShape& shape, const TetPoints& x);

/// One XPBD projection (multipliers start at 0 in each substep) of each constraint, the volume last:
///   dl = -C / (sum_i w_i |dC/dx_i|^2 + 1 / (stiffness V h^2)), dx_i = w_i dl dC/dx_i; stiffness 2 mu, k, lambda.
/// All three vanish at rest, so that they never fight: Macklin & Mueller 2021 take |F| for the distortion, which does not, and its
/// projection overshoots where h^2 stiffness is large beside the mass (measured, docs/rivals/xpbd-tet.md).
/// w: inverse masses of the corners (kg, when stresses are in kPa, lengths in mm and h in s); scale: millimetres per unit of x.
void project_tet(const TetMaterial& material, const TetShape& shape, TetPoints& x,
                 const std::array<double, 4>& inverse_mass, double h, double scale);

/// Least motion that brings the bound point to the target: dx_i = w_i b_i / (sum w_j b_j^2) (target - sum b_j x_j), b the weights.
/// Nothing moves when no corner can.
void project_point(TetPoints& x, const std::array<double, 4>& weights, const Vec3& target,
                   const std::array<double, 4>& inverse_mass);

} // namespace fascicle::solver
