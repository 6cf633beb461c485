#include "solver/methods/methods.hpp"
#include "solver/rivals/fem_body.hpp"

namespace fascicle::solver {

SolverMethod fem_method() {
    return {
        "fem",
        "corotational tetrahedra with fibres in a lattice, in equilibrium in every pass",
        true,
        1,
        "passes",
        solver::make_fem_solver,
        {},
        {{"solver.frame_time", "fem is in equilibrium in every pass: it knows no time"},
         {"solver.kernel", "only the method xpbd uses it"},
         {"solver.coarse", "only the method xpbd uses it"},
         {"solver.stiffness", "the tetrahedra's elasticity keeps the shape: fem.young_kpa"},
         {"solver.bending", "the tetrahedra's elasticity keeps the shape: fem.young_kpa"},
         {"solver.anisotropy", "the fibres have a stiffness of their own: fem.fibre_kpa"},
         {"solver.damping", "fem is in equilibrium in every pass: nothing swings"}},
        {{"fem.young_kpa",
          "Young's modulus",
          "kPa",
          ParamKind::real,
          0.1,
          10000,
          30,
          {},
          "Stiffness of the tissue; bones move as they are told, so it counts against the fibres' stiffness "
          "alone.",
          "methods notes, section 6.4: 20 to 60 kPa",
          true},
         {"fem.poisson",
          "Poisson's ratio",
          "1",
          ParamKind::real,
          0,
          0.49,
          0.47,
          {},
          "How much the tissue narrows as it is stretched; at 0.5 it would keep its volume everywhere.",
          "methods notes, section 6.4",
          false},
         {"fem.fibre_kpa",
          "Fibre stiffness",
          "kPa",
          ParamKind::real,
          0,
          10000,
          30,
          {},
          "Stiffness that the fibres add where they are stretched beyond rest; 0 is isotropic.",
          "Blemker, Pinsky, Delp 2005, with a straight passive curve",
          false},
         {"fem.spacing_mm",
          "Lattice spacing",
          "mm",
          ParamKind::real,
          0.5,
          100,
          10,
          {},
          "Edge of the lattice's cubes, each of 12 tetrahedra; coarser by itself above 60000 tetrahedra, "
          "finer for "
          "a body of less than six cubes.",
          "docs/rivals/fem.md",
          true}}};
}

} // namespace fascicle::solver
