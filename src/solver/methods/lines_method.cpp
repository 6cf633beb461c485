#include "solver/methods/methods.hpp"
#include "solver/rivals/lines/lines_solver.hpp"

namespace fascicle::solver {

// Lines have no volume: solver.volume is free (1).
SolverMethod lines_method() {
    return {"lines",
            "line segments with via points and wrapping over the bones, which the surface goes with",
            true,
            1,
            "passes",
            make_lines_solver,
            {{"solver.volume", 1.0}},
            {{"solver.kernel", "only the method xpbd uses it"},
             {"solver.coarse", "only the method xpbd uses it"},
             {"solver.frame_time", "lines depend on the pose of the bones; time plays no part"},
             {"solver.stiffness", "a line is as long as its way is; it has no stiffness"},
             {"solver.bending", "a line is tight over the bones; it has no stiffness"},
             {"solver.anisotropy", "the lines are the fibres; there is nothing across them"},
             {"solver.damping", "lines have no velocities"},
             {"solver.tone", "lines are always tight"}},
            {{"lines.count",
              "Lines",
              "1",
              ParamKind::integer,
              1,
              100,
              12,
              {},
              "How many lines run from one attachment to the other, spread evenly.",
              "docs/rivals/lines.md",
              false},
             {"lines.via",
              "Via points",
              "1",
              ParamKind::integer,
              0,
              8,
              3,
              {},
              "Points on the muscle's middle at rest that a line passes, each fixed to the bone whose "
              "attachment is next to it; 0: the line is tight from end to end.",
              "methods notes, section 6.1",
              false}}};
}

} // namespace fascicle::solver
