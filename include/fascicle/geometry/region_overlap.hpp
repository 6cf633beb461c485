#pragma once
// How well two regions of one surface agree.

#include "fascicle/geometry/surface_graph.hpp"
#include "fascicle/geometry/surface_region.hpp"

namespace fascicle {

/// Areas in scene units squared, a vertex counting for a third of each of its triangles (SurfaceGraph::vertex_area).
struct RegionOverlap {
    double first = 0, second = 0; ///< area of each region
    double both = 0;              ///< of what lies in the two

    double either() const { return first + second - both; }
    /// 2 |A and B| / (|A| + |B|) (Dice 1945): 1 for the same region, 0 for regions apart, and for two without area.
    double dice() const { return first + second > 0 ? 2 * both / (first + second) : 0.0; }
    /// |A and B| / |A or B| (Jaccard 1901), which is dice / (2 - dice).
    double jaccard() const { return either() > 0 ? both / either() : 0.0; }
};

/// Both regions must be of the graph's surface (FASCICLE_ASSERT).
RegionOverlap overlap_of(const SurfaceGraph& graph, const SurfaceRegion& first, const SurfaceRegion& second);

} // namespace fascicle
