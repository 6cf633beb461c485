#pragma once
// Exact distances to a surface at the nodes of a regular grid, written from the surface instead of looked up
// from the nodes.

#include "fascicle/base/job_control.hpp"
#include "grid_sign.hpp"

#include <functional>

namespace fascicle {

/// squared[n]: squared distance from node n to the nearest triangle in units of shape.h^2, rounded down to a
/// float, where that distance is below `reach` (scene units), else left as it is. `squared` must hold
/// infinity at every node (or larger values than those of this mesh).
///
/// The nearest point of a surface lies in the interior of a triangle, on an edge or at a corner. Seen from it the node
/// lies in the prism over the triangle, in the wedge between the planes that stand on the edge's triangles, or in the
/// cone whose directions make no acute angle with any edge of the corner (Mauch 2000, "A fast algorithm for computing
/// the closest point and distance transform", characteristic polyhedra). Each of these pieces is cut into grid slices,
/// and the nodes of a box around each cut receive the distance to the triangle, edge or corner where it is lower. So
/// every node near the surface is visited a few times only. A box may be too large but never gives a wrong value: what
/// is written is the distance to a point of the surface. Edges with one triangle or with more than two, thin triangles
/// and corners of any kind are covered, at the cost of more visits.
///
/// The result is the same for every number of threads. progress(share) is called from this thread. Throws
/// Cancelled.
void splat_squared_distances(const GridShape& shape, const Points& points, const std::vector<Tri>& triangles,
                             double reach, int threads, const JobControl& control,
                             const std::function<void(double)>& progress, float* squared);

} // namespace fascicle
