#pragma once
// Method fem: corotational tetrahedra in an embedding lattice with fibres, in equilibrium in every pass. docs/rivals/fem.md.

#include "fascicle/solver/soft_body_solver.hpp"

namespace fascicle::solver {

/// Attached vertices pull at the lattice by springs instead of fixing nodes, which would make everything within a tetrahedron of an
/// attachment rigid: 1000 E area / spacing, so that the lattice gives by about strain * spacing / 1000 (the surface itself does not:
/// its attached vertices are put in place). Touched vertices stand in by about strain * spacing / 10, and contact takes the rest.
inline double attachment_stiffness(double young, double area, double spacing) {
    return 1000.0 * young * area / spacing;
}
inline double contact_stiffness(double young, double area, double spacing) {
    return 10.0 * young * area / spacing;
}

/// Every solid must have its grid.
std::unique_ptr<SoftBodySolver> make_fem_solver(const SoftBodyProblem& problem);

} // namespace fascicle::solver
