#include "solver/methods/methods.hpp"
#include "solver/rivals/rbf/rbf_solver.hpp"

namespace fascicle::solver {

SolverMethod rbf_method() {
    return {"rbf",
            "a smooth displacement field through attachments and contacts, by radial basis functions",
            true,
            1,
            "passes",
            solver::make_rbf_solver,
            {},
            {{"solver.kernel", "only the method xpbd uses it"},
             {"solver.coarse", "only the method xpbd uses it"},
             {"solver.frame_time", "rbf depends on the pose of the bones; time plays no part"},
             {"solver.stiffness", "rbf interpolates in space and knows no edges"},
             {"solver.bending", "rbf interpolates in space and knows no dihedral angles"},
             {"solver.anisotropy", "rbf interpolates in space and knows no fibres"},
             {"solver.damping", "rbf has no velocities"},
             {"solver.tone", "rbf interpolates in space and knows no fibres"}},
            {{"rbf.kernel",
              "Radial function",
              "1",
              ParamKind::choice,
              0,
              1,
              0,
              {"linear", "cubic"},
              "linear: r, the least-energy field in space (biharmonic); cubic: r^3, smoother and farther "
              "reaching.",
              "methods notes, section 6.2",
              false},
             {"rbf.centres",
              "Attachment centres",
              "1",
              ParamKind::integer,
              4,
              1500,
              1000,
              {},
              "At most so many attached vertices, evenly spread, are centres of the field.",
              "methods notes, section 6.2",
              false},
             {"rbf.contacts",
              "Contact centres",
              "1",
              ParamKind::integer,
              0,
              500,
              200,
              {},
              "At most so many vertices that would enter a bone become centres where contact puts them; 0 "
              "leaves "
              "contact to the step after.",
              "methods notes, section 6.2",
              false}}};
}

} // namespace fascicle::solver
