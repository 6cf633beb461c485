#pragma once
// Which vertices of a muscle are fixed to which bones, and why: explicit, from areas, from outlines, or by nearness.

#include "fascicle/anatomy/outline_bone.hpp"
#include "fascicle/geometry/surface_graph.hpp"
#include "fascicle/scene/scene.hpp"

namespace fascicle {

/// What resolving needs to know of each bone; one entry per bone of the scene.
struct BoneQuery {
    DistanceToBone distance;
    bool moves = false;
    std::function<const SurfaceGraph&()> surface = {}; ///< of the bone's mesh; empty: made when needed
};

/// Attachments of one muscle, at most one bone per vertex (the first that claims it). Adds sentences to notes.
/// nearness: whether a muscle with neither attachments, areas nor outlines is attached by distance.
std::vector<Attachment> resolve_attachments(const Scene& scene, const Muscle& muscle,
                                            const MeshTopology& topology, const std::vector<BoneQuery>& bones,
                                            bool nearness, std::vector<std::string>& notes);

/// Bone of the scene that an outline belongs to: the one of its name, else the nearest; it lies on it up to a mean distance of
/// 3 mm.
OutlineBone find_outline_bone(const Scene& scene, const AttachmentOutline& outline,
                              const std::vector<BoneQuery>& bones);

} // namespace fascicle
