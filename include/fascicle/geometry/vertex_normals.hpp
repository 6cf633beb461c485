#pragma once
// Smooth normals for drawing and for offsets along the surface.

#include "fascicle/base/types.hpp"

namespace fascicle {

/// One unit normal per point: the normalised sum of the normals of its triangles, each weighted by the triangle's angle
/// at the point, n = sum_t alpha_t n_t / |sum_t alpha_t n_t| (Thuermer and Wuethrich, "Computing vertex normals from
/// polygonal facets", J. Graphics Tools 3(1), 1998). Does not depend on how a flat face is cut into triangles.
/// Points outwards for counter-clockwise triangles. Zero for a point without triangles, for one whose triangles all have
/// no area, and where the sum cancels. Coordinates must be finite, indices in range.
Points vertex_normals(const Points& points, const std::vector<Tri>& triangles);

} // namespace fascicle
