#include "fascicle/solver/soft_body_solver.hpp"
#include "solver/classic/classic_solver.hpp"
#include "solver/rivals/fem_body.hpp"
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
        {"fem",
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
           8,
           {},
           "Edge of the lattice's cubes, each of 12 tetrahedra; coarser by itself above 60000 tetrahedra, "
           "finer for "
           "a body of less than six cubes.",
           "docs/rivals/fem.md",
           true}}},
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
