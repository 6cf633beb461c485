#include "solver/methods/methods.hpp"
#include "solver/rivals/xpbd_tet_body.hpp"

namespace fascicle::solver {

SolverMethod xpbd_tet_method() {
    return {
        "xpbd-tet",
        "compliant tetrahedra with fibres in a lattice, in substeps",
        true,
        10,
        "substeps",
        solver::make_xpbd_tet_solver,
        {{"solver.damping", 30}},
        {{"solver.kernel", "only the method xpbd uses it"},
         {"solver.coarse", "only the method xpbd uses it"},
         {"solver.stiffness", "the tetrahedra's elasticity keeps the shape: xpbd-tet.young_kpa"},
         {"solver.bending", "the tetrahedra's elasticity keeps the shape: xpbd-tet.young_kpa"},
         {"solver.anisotropy", "the fibres have a stiffness of their own: xpbd-tet.fibre_kpa"}},
        {{"xpbd-tet.young_kpa",
          "Young's modulus",
          "kPa",
          ParamKind::real,
          0.1,
          10000,
          30,
          {},
          "Stiffness of the tissue at small strain, against its mass (1056 kg/m3) and the fibres' "
          "stiffness.",
          "methods notes, section 6.4: 20 to 60 kPa",
          true},
         {"xpbd-tet.poisson",
          "Poisson's ratio",
          "1",
          ParamKind::real,
          0,
          0.499,
          0.47,
          {},
          "How much the tissue narrows as it is stretched; nearer to 0.5 its volume is kept more strictly "
          "everywhere.",
          "methods notes, section 6.4",
          false},
         {"xpbd-tet.fibre_kpa",
          "Fibre stiffness",
          "kPa",
          ParamKind::real,
          0,
          10000,
          30,
          {},
          "Stiffness that the fibres add where they are stretched beyond rest; 0 is isotropic.",
          "methods notes, section 6.4",
          false},
         {"xpbd-tet.spacing_mm",
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
          "docs/rivals/xpbd-tet.md",
          true}}};
}

} // namespace fascicle::solver
