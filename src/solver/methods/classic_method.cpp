#include "solver/classic/classic_solver.hpp"
#include "solver/methods/methods.hpp"

namespace fascicle::solver {

// Defaults of the published program: edges rigid but for the fibres, bending 0.9, velocity factor 0.99 a
// millisecond (10.05 1/s).
SolverMethod classic_method() {
    return {"classic",
            "the published program step by step, the yardstick",
            false,
            3,
            "inner loops",
            make_classic_solver,
            {{"solver.stiffness", 1.0}, {"solver.bending", 0.9}, {"solver.damping", 10.050335853501450}},
            {{"solver.frame_time", "classic takes 1 ms an inner loop"},
             {"solver.kernel", "only the method xpbd uses it"},
             {"solver.coarse", "only the method xpbd uses it"},
             {"solver.tone", "the published method has none"},
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
              false}}};
}

} // namespace fascicle::solver
