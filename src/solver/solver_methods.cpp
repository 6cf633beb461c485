#include "fascicle/solver/soft_body_solver.hpp"
#include "solver/classic/classic_solver.hpp"
#include "solver/xpbd/xpbd_solver.hpp"

#include <algorithm>

namespace fascicle {

const std::vector<SolverMethod>& solver_methods() {
    static const std::vector<SolverMethod> methods = {
        {"xpbd", "compliant constraints in substeps, contact by distance grids", true,
         solver::make_xpbd_solver},
        {"classic", "the published program step by step: the yardstick", false, make_classic_solver},
    };
    return methods;
}

const SolverMethod* find_solver_method(std::string_view name) {
    const auto& methods = solver_methods();
    const auto it =
        std::find_if(methods.begin(), methods.end(), [&](const SolverMethod& m) { return m.name == name; });
    return it == methods.end() ? nullptr : &*it;
}

} // namespace fascicle
