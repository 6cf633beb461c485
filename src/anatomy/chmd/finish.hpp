#pragma once
// From a strand and its two ends to a smooth fibre inside the muscle.

#include "ends.hpp"

namespace fascicle::chmd {

/// The centripetal curve from `from` over the strand between its trims to `to`; where it is outside the muscle it is put
/// onto the surface and smoothed; then `segments` + 1 points at equal arcs, each put onto the surface if the winding number
/// finds it outside. The ends are kept exactly. solid: of the mesh.
Points finish_fibre(const TriMesh& mesh, const SolidQuery& solid, const Strand& strand, double trim_from,
                    double trim_to, const Vec3& from, const Vec3& to, int segments);

} // namespace fascicle::chmd
