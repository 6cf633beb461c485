#pragma once
// The method `rbf`: a displacement field in space through attachments and contacts (docs/rivals/rbf.md).

#include "fascicle/solver/soft_body_solver.hpp"

namespace fascicle::solver {

/// Every solid must have its grid.
std::unique_ptr<SoftBodySolver> make_rbf_solver(const SoftBodyProblem& problem);

} // namespace fascicle::solver
