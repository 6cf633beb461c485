#pragma once
// The methods, a row and a file each; solver_methods() puts them in the order in which people see them.

#include "fascicle/solver/soft_body_solver.hpp"

namespace fascicle::solver {

SolverMethod xpbd_method();
SolverMethod classic_method();
SolverMethod mass_spring_method();
SolverMethod arap_method();
SolverMethod rbf_method();
SolverMethod fem_method();
SolverMethod xpbd_tet_method();
SolverMethod lines_method();

} // namespace fascicle::solver
