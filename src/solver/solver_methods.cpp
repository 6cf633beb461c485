#include "fascicle/solver/soft_body_solver.hpp"
#include "solver/classic/classic_solver.hpp"
#include "solver/rivals/mass_spring/mass_spring_body.hpp"
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
        // Janak's model has no volume term: solver.volume is free (1).
        {"mass-spring",
         "particles and springs inside the muscle, the group's earlier model",
         true,
         5,
         "contact rounds",
         make_mass_spring_solver,
         {{"solver.volume", 1.0}},
         {{"solver.frame_time",
           "a step is as long as Janak's, 0.4, and there are mass-spring.steps of them a frame"},
          {"solver.kernel", "only the method xpbd uses it"},
          {"solver.coarse", "only the method xpbd uses it"},
          {"solver.tone", "only the method xpbd uses it"},
          {"solver.stiffness",
           "springs alone hold the shape: a common stiffness would only change how fast it settles"},
          {"solver.bending", "springs inside hold the shape; the surface has no stiffness of its own"},
          {"solver.anisotropy", "springs are alike along and across the fibres"},
          {"solver.damping", "mass-spring.damping takes its place"}},
         {{"mass-spring.springs",
           "Springs",
           "1",
           ParamKind::choice,
           0,
           2,
           1,
           {"lattice6", "lattice26", "nearest15"},
           "Which particles are joined: neighbours of the lattice along its axes, along its diagonals too, "
           "or the 15 "
           "nearest.",
           "Janak 2012",
           false},
          {"mass-spring.particles",
           "Particles",
           "1",
           ParamKind::integer,
           50,
           20000,
           2000,
           {},
           "About how many particles a muscle has, inside and on its surface.",
           "Janak 2012: 64 fibres of 20 to 80 points",
           true},
          {"mass-spring.steps",
           "Steps a frame",
           "1",
           ParamKind::integer,
           1,
           2000,
           70,
           {},
           "Verlet steps a frame, spread over its passes.",
           "Janak 2012",
           true},
          {"mass-spring.damping",
           "Spring damping",
           "1",
           ParamKind::real,
           0,
           2,
           1,
           {},
           "Damping c of the Verlet step: a share of 0.4 c of a particle's velocity is lost in each.",
           "Janak 2012",
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
