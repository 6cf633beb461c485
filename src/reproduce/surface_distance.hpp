#pragma once
// How far two shapes of one mesh are apart.

#include "fascicle/geometry/tri_mesh.hpp"
#include "reproduce/results.hpp"

namespace fascicle::reproduce {

/// Distances of every vertex of a to the surface of b and of every vertex of b to that of a: mean over all of them, and the largest (the
/// symmetric Hausdorff distance, sampled at vertices). a, b: as many points as the mesh has vertices; unit_mm: millimetres in a scene unit.
SurfaceDistance surface_distance(const Points& a, const Points& b, const std::vector<Tri>& triangles,
                                 double unit_mm);

} // namespace fascicle::reproduce
