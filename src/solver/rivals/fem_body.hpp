#pragma once
// Method fem: corotational tetrahedra in an embedding lattice with fibres, in equilibrium in every pass. docs/rivals/fem.md.

#include "fascicle/solver/soft_body_solver.hpp"

namespace fascicle::solver {

/// Every solid must have its grid.
std::unique_ptr<SoftBodySolver> make_fem_solver(const SoftBodyProblem& problem);

} // namespace fascicle::solver
