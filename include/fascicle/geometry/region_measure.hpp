#pragma once
// Numbers of a region: area, centroid, islands, holes.

#include "fascicle/geometry/surface_graph.hpp"
#include "fascicle/geometry/surface_region.hpp"

namespace fascicle {

/// A vertex stands for a third of each of its triangles (SurfaceGraph::vertex_area), so the areas of a region and of its
/// complement sum to that of the surface.
struct RegionMeasure {
    int vertices = 0;
    double area = 0; ///< sum of the vertices' areas, scene units squared
    Vec3 centroid =
        Vec3::Zero(); ///< sum of area x position / area; the plain mean when the area is 0; zero when empty
    int islands = 0;  ///< parts connected by edges
    int holes = 0;    ///< see region_holes
};

RegionMeasure measure_region(const SurfaceGraph& graph, const SurfaceRegion& region);

/// Connected parts of a region, by edges, in the order of their lowest vertex; vertices of each ascending. Vertices that
/// no triangle uses are parts of their own.
std::vector<std::vector<int>> region_parts(const SurfaceGraph& graph, const SurfaceRegion& region);

/// Holes: connected parts of the complement that the region surrounds. On a closed surface each side of a border
/// could be the inside, so: a part whose area is less than that of the region's islands at its border, and that is not the
/// largest part of the complement on its component of the surface. A belt round a shaft thus has no hole. Vertices of each
/// hole ascending, in the order of the lowest vertex. Looks at the complement from the region's border outwards and stops at
/// a part once it is too large, so a small region costs little on a large surface.
std::vector<std::vector<int>> region_holes(const SurfaceGraph& graph, const SurfaceRegion& region);

} // namespace fascicle
