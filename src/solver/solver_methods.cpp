#include "fascicle/solver/soft_body_solver.hpp"
#include "solver/classic/classic_solver.hpp"
#include "solver/rivals/arap/arap_solver.hpp"
#include "solver/rivals/rbf/rbf_solver.hpp"
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
        {"arap",
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
           false}}},
        {"rbf",
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
