#pragma once
// Bones that are inside each other, at rest or while they move: where that happens no muscle can be outside of both, and
// contact has no answer.

#include "fascicle/base/job_control.hpp"
#include "fascicle/geometry/bvh.hpp"
#include "fascicle/geometry/distance_grid.hpp"
#include "fascicle/scene/scene.hpp"

#include <span>

namespace fascicle {

/// A bone as it is looked up: its surface in its rest frame, the search tree of that, and a grid that may be null.
struct OverlapBone {
    const TriMesh* mesh = nullptr;
    const TriangleBvh* tree = nullptr;
    const DistanceGrid* grid = nullptr;
};

/// a < b. Lengths in scene units.
struct BoneOverlap {
    int a = 0, b = 0;
    double depth = 0;          ///< of the deepest vertex of one inside the other, exact
    int frame = 0;             ///< where that was
    int first_frame = 0;       ///< first frame looked at in which a vertex was deeper than the least depth
    Vec3 place = Vec3::Zero(); ///< the deepest vertex, scene coordinates of that frame
};

/// Every pair with a vertex of one deeper than least_depth (> 0) in the other, sorted by a, b. A pair is looked at in at
/// most 150 frames in which its bones stand in different ways to each other: once when neither moves against the other.
/// Inside = generalised winding number > 0.5. Vertices only: an edge that crosses a large triangle is not seen.
/// Work: a cluster of vertices is looked at again only when it has moved, seen from the other bone, as far as it was away
/// from it; and a vertex is looked up exactly only where the grid (whose positive values lie outside of the bone) says
/// that it may be inside. Throws Cancelled.
std::vector<BoneOverlap> find_bone_overlaps(std::span<const OverlapBone> bones, const Timeline& timeline,
                                            double least_depth, const JobControl& control = {});

/// A sentence for the user.
std::string overlap_note(const Scene& scene, const BoneOverlap& overlap);

} // namespace fascicle
