#pragma once
// What is put right before the first frame: vertices inside bones, and attachments that another bone would run into.

#include "fascicle/anatomy/attachment.hpp"
#include "fascicle/base/pose.hpp"
#include "fascicle/geometry/distance_grid.hpp"
#include "fascicle/motion/timeline.hpp"

#include <span>

namespace fascicle {

struct CleanUpResult {
    int moved = 0;
    int still_inside = 0;     ///< free vertices that no short move puts outside
    double largest_shift = 0; ///< scene units
};

/// Moves every vertex that is free (body_of_vertex -1) and nearer than `offset` to a solid at rest out to it, along the
/// gradients of the grids (at most 20 steps).
CleanUpResult push_out_at_rest(Points& positions, const std::vector<int>& body_of_vertex,
                               std::span<const DistanceGrid* const> grids, double offset);

/// An attached vertex that another bone comes nearer to than this is released.
inline constexpr double sweep_clearance_mm = 0.5;

/// Releases attached vertices that some other bone approaches during the motion to less than `clearance` (and less than at
/// rest): they would be driven into it, since nothing may move them. Looks at up to 151 frames spread over the timeline.
/// Returns the number of vertices released. Source: contact notes, "sweep test".
int release_swept_attachments(std::vector<Attachment>& attachments, const Points& rest,
                              const Timeline& timeline, std::span<const DistanceGrid* const> grids,
                              double clearance);

} // namespace fascicle
