#pragma once
// Regions from lines on a surface: what a closed chain of lines encloses, and a strip along lines.

#include "fascicle/geometry/geodesic_line.hpp"
#include "fascicle/geometry/surface_region.hpp"

#include <optional>

namespace fascicle {

/// lines: each begins where the one before ends, in the same triangle, and the last ends where the first begins. The vertices
/// on the lines and all parts that the lines cut off from their connected part of the surface, but the largest by area: of a
/// simple loop the smaller side. An edge crossed an even number of times is not cut. Nothing when the lines cut nothing off.
std::optional<SurfaceRegion> enclosed_by_lines(const SurfaceGraph& graph,
                                               const std::vector<GeodesicLine>& lines);

/// Vertices within half_width (scene units, along the surface) of the lines and of `ends`, and at least the nearest vertex of every
/// edge that the lines cross, so that the strip hangs together where the triangles are wider than it. ends: points
/// with a triangle, e.g. those that the lines join.
SurfaceRegion strip_along_lines(GeodesicSearch& search, const std::vector<SurfacePoint>& ends,
                                const std::vector<GeodesicLine>& lines, double half_width);

} // namespace fascicle
