#pragma once
// The border of a region as closed lines on the surface.

#include "fascicle/geometry/surface_graph.hpp"
#include "fascicle/geometry/surface_region.hpp"

namespace fascicle {

/// A point of a border: the middle of the edge from a vertex inside to one outside, or (outside == -1) the vertex inside,
/// at an open border of the surface itself.
struct BorderPoint {
    int inside = -1;
    int outside = -1;
    friend bool operator==(const BorderPoint&, const BorderPoint&) = default;
};

/// closed: always, unless the surface is non-manifold there. Counter-clockwise about the region seen from outside, where
/// the surface is oriented.
struct BorderLoop {
    std::vector<BorderPoint> points;
    bool closed = true;
};

/// Loops in the order of their lowest edge, each starting there. The line crosses every edge between in and out at its
/// middle, through every triangle that has both, so it parts the region from the rest exactly, never touches itself, and
/// encloses 1/4, 3/4 or all of a triangle with 1, 2 or 3 corners inside (thirds in the mean). Along an open border of the
/// surface the loop follows that border. Empty for an empty region and for a whole closed surface.
std::vector<BorderLoop> region_border(const SurfaceGraph& graph, const SurfaceRegion& region);

/// Positions of a loop's points, in order; the first is not repeated.
Points border_positions(const SurfaceGraph& graph, const BorderLoop& loop);

/// Length of a loop, scene units.
double border_length(const SurfaceGraph& graph, const BorderLoop& loop);

} // namespace fascicle
