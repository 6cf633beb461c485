#pragma once
// The same method as the plain kernel (xpbd/xpbd_solver.hpp), laid out for the machine: floats in packets of 16 without common vertices, swept
// colour by colour, blocks of the mesh on separate threads. Bit-identical for any number of threads; differs from the plain kernel in
// the order of constraints and in rounding. Design and figures: docs/performance.md.

#include "fascicle/solver/soft_body_solver.hpp"
#include "solver/fast/layout.hpp"

namespace fascicle::solver {

/// Null when the mesh does not suit it (see fast::make_plan); the plain kernel takes any.
/// kernels: of one instruction set; null takes the fastest that the processor has.
std::unique_ptr<SoftBodySolver> make_fast_solver(const SoftBodyProblem& problem,
                                                 const fast::Kernels* kernels = nullptr);

} // namespace fascicle::solver
