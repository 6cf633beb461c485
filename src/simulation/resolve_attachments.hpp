#pragma once
// Which vertices of a muscle are fixed to which bones, and why: explicit, from outlines, or by nearness.

#include "fascicle/anatomy/attach.hpp"
#include "fascicle/scene/scene.hpp"

namespace fascicle {

/// What resolving needs to know of each bone; one entry per bone of the scene.
struct BoneQuery {
    BoneDistance distance;
    bool moves = false;
};

/// Attachments of one muscle, at most one bone per vertex (the first that claims it). Adds sentences to notes.
/// nearness: whether a muscle with neither attachments nor outlines is attached by distance.
std::vector<Attachment> resolve_attachments(const Scene& scene, const Muscle& muscle,
                                            const MeshTopology& topology, const std::vector<BoneQuery>& bones,
                                            bool nearness, std::vector<std::string>& notes);

/// Bone of the scene that an outline belongs to: the one of its name, else the one its points lie on (mean distance up to
/// 3 mm), else the nearest. `on_bone` tells whether the outline lies on it. -1 without bones.
struct OutlineBone {
    int bone = -1;
    bool on_bone = false;
    double mean_distance = 0; ///< scene units
};
OutlineBone find_outline_bone(const Scene& scene, const AttachmentOutline& outline,
                              const std::vector<BoneQuery>& bones);

} // namespace fascicle
