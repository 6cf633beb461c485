#pragma once
// Method xpbd-tet: tetrahedral XPBD in an embedding lattice, with volume, distortion and fibre terms. docs/rivals/xpbd-tet.md.

#include "fascicle/solver/soft_body_solver.hpp"

namespace fascicle::solver {

/// Every solid must have its grid.
std::unique_ptr<SoftBodySolver> make_xpbd_tet_solver(const SoftBodyProblem& problem);

} // namespace fascicle::solver
