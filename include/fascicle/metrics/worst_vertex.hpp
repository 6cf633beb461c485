#pragma once
// The one vertex of a frame to look at first when contact is in doubt.

#include "fascicle/geometry/solid_query.hpp"
#include "fascicle/scene/recording.hpp"

#include <optional>

namespace fascicle {

struct WorstVertex {
    int muscle = -1, vertex = -1, bone = -1; ///< numbers in the scene
    double depth_mm = 0;                     ///< positive inside the bone, negative outside
    bool penetrating = false;                ///< counted by PenetrationMeasure: deeper than its tolerance
    Vec3 point = Vec3::Zero();               ///< scene units
};

/// The deepest penetrating vertex of all muscles; when none penetrates, the vertex nearest to a bone among those
/// that are not attached and not deeper inside than the tolerance (deeper ones were inside at rest). Nothing
/// without such a vertex, or without bones. Of equals the first.
///
/// rest: frame 0. attachments: in force, one list per muscle, or fewer. bones: bone_solids(scene).
std::optional<WorstVertex> worst_vertex(const Scene& scene, const Frame& rest, const Frame& frame,
                                        const std::vector<std::vector<Attachment>>& attachments,
                                        const std::vector<std::shared_ptr<const SolidQuery>>& bones,
                                        int threads = 1);

} // namespace fascicle
