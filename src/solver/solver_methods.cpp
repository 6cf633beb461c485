#include "fascicle/solver/soft_body_solver.hpp"
#include "solver/classic/classic_solver.hpp"
#include "solver/xpbd/xpbd_solver.hpp"

#include <algorithm>

namespace fascicle {

const std::vector<SolverMethod>& solver_methods() {
    static const std::vector<SolverMethod> methods = {
        {"xpbd",
         "compliant constraints in substeps, contact by distance grids",
         true,
         10,
         "substeps",
         solver::make_xpbd_solver,
         {},
         {},
         {}},
        // Defaults of the published program: edges rigid but for the fibres, bending 0.9, velocity factor 0.99 a
        // millisecond (10.05 1/s).
        {"classic",
         "the published program step by step, the yardstick",
         false,
         3,
         "inner loops",
         make_classic_solver,
         {{"solver.stiffness", 1.0}, {"solver.bending", 0.9}, {"solver.damping", 10.050335853501450}},
         {{"solver.frame_time", "classic takes 1 ms an inner loop"},
          {"solver.kernel", "only the method xpbd uses it"},
          {"solver.coarse", "only the method xpbd uses it"},
          {"solver.tone", "only the method xpbd uses it"},
          {"contact.", "classic stops a vertex where it is inside a bone, without distance grids"},
          {"attachment.distance_mm", "classic fixes what lies inside a bone at the start"}},
         {{"classic.equations",
           "Classic equations",
           "1",
           ParamKind::choice,
           0,
           1,
           0,
           {"published", "meant"},
           "published: every quirk of the program; meant: the paper's equations with right signs and "
           "factors.",
           "Cervenka & Kohout 2020",
           false}}},
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
