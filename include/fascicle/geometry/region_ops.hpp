#pragma once
// What a paint tool does to a region besides brushing: region in, region out. None changes its input, all give the same
// bits for the same input, and all work on an empty region and on any surface that SurfaceGraph takes.

#include "fascicle/geometry/geodesic_search.hpp"
#include "fascicle/geometry/surface_region.hpp"

namespace fascicle {

/// Region and the neighbours of its vertices; the region without the vertices that have a neighbour outside. An open
/// border of the surface is not outside. shrink_ring(grow_ring(r)) includes r.
SurfaceRegion grow_ring(const SurfaceGraph& graph, const SurfaceRegion& region);
SurfaceRegion shrink_ring(const SurfaceGraph& graph, const SurfaceRegion& region);

/// Moves the border by `distance` along the surface: adds the vertices outside, or takes away those inside, up to that
/// distance from the border, which runs through the middles of edges (so the area is right in the mean, and nothing happens
/// below half an edge). Scene units, >= 0. WaveFront::plane.
SurfaceRegion grow(GeodesicSearch& search, const SurfaceRegion& region, double distance);
SurfaceRegion shrink(GeodesicSearch& search, const SurfaceRegion& region, double distance);

/// Vertices connected with `vertex` by edges whose ends are all in the region, or all out of it, as the vertex is.
SurfaceRegion connected_part(const SurfaceGraph& graph, const SurfaceRegion& region, int vertex);

/// Bucket: adds what is enclosed by the border around `vertex` (nothing when it lies in the region already). As an
/// eraser: takes away the island of `vertex`.
SurfaceRegion bucket_fill(const SurfaceGraph& graph, const SurfaceRegion& region, int vertex);
SurfaceRegion bucket_erase(const SurfaceGraph& graph, const SurfaceRegion& region, int vertex);

/// The island of the largest area, of equal ones that with the lowest vertex.
SurfaceRegion keep_largest(const SurfaceGraph& graph, const SurfaceRegion& region);

/// Adds the holes (region_holes) of at most `largest_area`, scene units squared.
SurfaceRegion fill_holes(const SurfaceGraph& graph, const SurfaceRegion& region,
                         double largest_area = std::numeric_limits<double>::infinity());

/// Smart fill: corners of the triangles that hang together with `triangle` through edges whose faces' normals differ by at
/// most `crease_rad` (a triangle without area stops nothing). Does not cross vertices of `barrier` (a painted border): a
/// triangle with a corner in it is not entered, unless it is the first. Only triangles with a corner within `reach` of `centre`
/// in a straight line are entered.
struct SmartFill {
    int triangle = -1;
    double crease_rad = 0.5235987755982988; ///< 30 degrees
    const SurfaceRegion* barrier = nullptr;
    Vec3 centre = Vec3::Zero();
    double reach = std::numeric_limits<double>::infinity();
};
SurfaceRegion smart_fill(const SurfaceGraph& graph, const SmartFill& fill);

/// Smooths the border and keeps the area to half a vertex's: the indicator (1 in, 0 out) is averaged with its neighbours,
/// weighted by 1 / edge length, `passes` times, and the vertices with the highest values are kept, as many as have the old
/// area (mean curvature motion after Merriman, Bence, Osher 1992, with the threshold that keeps the area). Only vertices
/// within `passes` edges of the border change, and only those of `within` when it is given.
SurfaceRegion smooth_border(const SurfaceGraph& graph, const SurfaceRegion& region, int passes = 4,
                            const SurfaceRegion* within = nullptr);

} // namespace fascicle
