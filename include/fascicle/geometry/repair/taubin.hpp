#pragma once
// Smoothing that does not shrink.

#include "fascicle/base/job_control.hpp"
#include "fascicle/geometry/tri_mesh.hpp"

namespace fascicle {

/// lambda > 0 smooths, mu < -lambda swells what that shrank. A frequency k (0 flat to 2) of the surface is multiplied by
/// (1 - lambda k)(1 - mu k) a pass: 1 at k = 1/lambda + 1/mu, less above (Taubin 1995, "A signal processing approach to fair
/// surface design", eqs. 8 to 12; the defaults are his).
struct TaubinOptions {
    double lambda = 0.5;
    double mu = -0.53;
    int passes = 10;
};

/// x_i += factor (mean of the neighbours - x_i) for all at once, with lambda, then with mu, `passes` times. Vertices at edges with
/// other than two triangles stay. Vertices and triangles keep their numbers. Cancelled when asked.
void taubin_smooth(TriMesh& mesh, const TaubinOptions& options, const JobControl& control = {});

} // namespace fascicle
