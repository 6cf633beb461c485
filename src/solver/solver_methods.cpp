#include "fascicle/solver/soft_body_solver.hpp"
#include "solver/methods/methods.hpp"

#include <algorithm>

namespace fascicle {

const std::vector<SolverMethod>& solver_methods() {
    using namespace solver;
    static const std::vector<SolverMethod> methods = {
        xpbd_method(), classic_method(), mass_spring_method(), arap_method(),
        rbf_method(),  fem_method(),     xpbd_tet_method(),    lines_method()};
    return methods;
}

const SolverMethod* find_solver_method(std::string_view name) {
    const auto& methods = solver_methods();
    const auto it =
        std::find_if(methods.begin(), methods.end(), [&](const SolverMethod& m) { return m.name == name; });
    return it == methods.end() ? nullptr : &*it;
}

} // namespace fascicle
