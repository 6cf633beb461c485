#include "solver/methods/methods.hpp"
#include "solver/xpbd/xpbd_solver.hpp"

namespace fascicle::solver {

SolverMethod xpbd_method() {
    return {"xpbd",     "compliant constraints in substeps, contact by distance grids",
            true,       10,
            "substeps", solver::make_xpbd_solver,
            {},         {},
            {}};
}

} // namespace fascicle::solver
