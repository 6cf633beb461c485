#pragma once
// The method `arap`: the surface as rigid as possible between its attachments, Sorkine & Alexa 2007 (docs/rivals/arap.md).

#include "fascicle/solver/soft_body_solver.hpp"

namespace fascicle::solver {

/// Every solid must have its grid.
std::unique_ptr<SoftBodySolver> make_arap_solver(const SoftBodyProblem& problem);

} // namespace fascicle::solver
