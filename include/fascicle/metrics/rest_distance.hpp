#pragma once
// How far a muscle's surface is from its rest shape.

#include "fascicle/geometry/bvh.hpp"

namespace fascicle {

/// Scene units. Only vertices that triangles use count; all values are 0 without triangles.
struct RestDistance {
    double mean = 0, rms = 0, max = 0; ///< of |x_i - x0_i| over the vertices
    /// Symmetric Hausdorff distance, sampled at the vertices: the largest distance of a vertex of one surface
    /// to the other surface.
    double hausdorff = 0;
};

class RestDistanceMeasure {
public:
    RestDistanceMeasure(const std::vector<Tri>& triangles, Points rest);
    /// points: V positions, as many as at rest.
    RestDistance measure(const Points& points);

private:
    double one_sided(const Points& from, const TriangleBvh& to, double known);

    Points rest_;
    TriangleBvh rest_tree_, now_tree_;                    ///< the second is refitted to every frame
    std::vector<int> used_;                               ///< vertices that triangles use, ascending
    std::vector<int> triangle_of_;                        ///< by vertex: one of its triangles
    std::vector<std::pair<double, int>> by_displacement_; ///< kept between calls
};

} // namespace fascicle
