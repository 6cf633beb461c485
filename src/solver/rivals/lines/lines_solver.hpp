#pragma once
// The muscle as musculoskeletal models have it: lines between its attachments, with via points and wrapping; the surface goes with them.

#include "fascicle/solver/soft_body_solver.hpp"

namespace fascicle::solver {

std::unique_ptr<SoftBodySolver> make_lines_solver(const SoftBodyProblem& problem);

} // namespace fascicle::solver
