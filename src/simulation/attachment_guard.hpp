#pragma once
// Attachments that a bone comes at during a run: seen before the frame in which they would be run into.

#include "fascicle/simulation/prepare.hpp"

namespace fascicle {

/// Watches the attached vertices of one muscle. prepare_scene() releases those that the known motion runs into, as far as the
/// frames it looks at tell; this looks at every frame as it comes, so it also serves bones that are moved by hand.
class AttachmentGuard {
public:
    /// clearance: scene units; a vertex is given up when another bone comes nearer than that, and nearer than at rest.
    AttachmentGuard(const SoftBodyProblem& problem, double clearance);

    /// Attached vertices to release before the bones go to the poses `to` (B, from rest), ascending; each is told once.
    const std::vector<int>& find(std::span<const Pose> to);

private:
    struct Watch {
        int vertex = -1, own = -1, other = -1;
        Vec3 last = Vec3::Zero(); ///< in the rest frame of `other`, when it was looked up
        double slack = 0;         ///< it may move so far from `last` before it can be too near
        double at_rest = 0;       ///< signed distance to `other` at rest
    };
    std::vector<std::shared_ptr<const DistanceGrid>> grids_;
    Points rest_;
    std::vector<Watch> watches_;
    std::vector<int> found_;
    double clearance_;
};

} // namespace fascicle
