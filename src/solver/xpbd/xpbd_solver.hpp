#pragma once
// Extended position-based dynamics, plain: double precision, one sweep of every constraint per substep, in a
// fixed order. Sources: Macklin et al. 2016 (XPBD), Macklin et al. 2019 (small steps); parameters mapped from
// Cervenka & Kohout 2020.

#include "fascicle/solver/soft_body_solver.hpp"

namespace fascicle::solver {

std::unique_ptr<SoftBodySolver> make_xpbd_solver(const SoftBodyProblem& problem);

} // namespace fascicle::solver
