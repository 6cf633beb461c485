#pragma once
// How much the edges of a muscle's surface have been stretched since rest.

#include "fascicle/geometry/mesh_topology.hpp"

namespace fascicle {

/// Ratios len(e) / len0(e) over the unique edges e of the surface (methods.md 7); dimensionless, 1 at rest.
/// Edges without length at rest are left out. All values are NaN without edges.
struct EdgeExtension {
    double mean = 0;
    double p1 = 0, p10 = 0, p25 = 0, p50 = 0, p75 = 0, p90 = 0, p99 = 0; ///< see percentile.hpp
    double max = 0;
};

class EdgeExtensionMeasure {
public:
    EdgeExtensionMeasure(const std::vector<Edge>& edges, const Points& rest);
    /// points: V positions, as many as at rest.
    EdgeExtension measure(const Points& points);

    /// Mean ratio of the edges at each vertex, V values; 1 at vertices without edges. For colouring.
    std::vector<double> at_vertices(const Points& points) const;

private:
    std::vector<Edge> edges_; ///< with a length
    std::vector<double> rest_lengths_;
    std::vector<double> ratios_, percentiles_; ///< kept between calls
};

} // namespace fascicle
