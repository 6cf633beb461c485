#include "solver/methods/methods.hpp"
#include "solver/rivals/arap/arap_solver.hpp"

namespace fascicle::solver {

SolverMethod arap_method() {
    return {
        "arap",
        "the surface as rigid as possible between its attachments, no time",
        true,
        2,
        "passes",
        solver::make_arap_solver,
        {},
        {{"solver.kernel", "only the method xpbd uses it"},
         {"solver.coarse", "only the method xpbd uses it"},
         {"solver.frame_time", "arap seeks the shape of least energy in every pose; time plays no part"},
         {"solver.stiffness", "one energy alone has no stiffness: its scale cancels"},
         {"solver.bending", "the cells of arap hold bends by themselves"},
         {"solver.damping", "arap has no velocities"},
         {"solver.tone", "arap is the passive surface as published"}},
        {{"arap.alternations",
          "Alternations a pass",
          "1",
          ParamKind::integer,
          1,
          100,
          6,
          {},
          "How often rotations and positions are fitted to each other in a pass.",
          "Sorkine & Alexa 2007",
          false},
         {"arap.contact",
          "Contact penalty",
          "1",
          ParamKind::real,
          0.01,
          100,
          2,
          {},
          "Penalty that holds a vertex off a bone within the alternations, as a multiple of its cell's "
          "weight.",
          "docs/rivals/arap.md",
          false},
         {"arap.volume",
          "Volume within",
          "1",
          ParamKind::choice,
          0,
          1,
          0,
          {"within", "after"},
          "within: a pressure in the alternations keeps the volume; after: only the step after them, as the "
          "recipe has it, which wrinkles the surface.",
          "docs/rivals/arap.md",
          false}}};
}

} // namespace fascicle::solver
