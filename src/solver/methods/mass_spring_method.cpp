#include "solver/methods/methods.hpp"
#include "solver/rivals/mass_spring/mass_spring_body.hpp"

namespace fascicle::solver {

// Janak's model has no volume term: solver.volume is free (1).
SolverMethod mass_spring_method() {
    return {
        "mass-spring",
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
         {"solver.tone", "its springs do not shorten by themselves"},
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
          false}}};
}

} // namespace fascicle::solver
