#pragma once
// Which points of a muscle are inside a bone that they were not inside of at rest, and how deep: exact.

#include "fascicle/base/pose.hpp"
#include "fascicle/metrics/tracked_point.hpp"

#include <memory>
#include <vector>

namespace fascicle {

struct Penetration {
    int count = 0;     ///< points deeper than the tolerance inside at least one bone
    double max_mm = 0; ///< greatest depth, tolerated ones included; 0 when no point is inside
};

/// Depth = distance to the bone's surface of a point inside (winding number > 0.5), in the bone's own frame,
/// 0 outside. A point inside a bone at rest (by any depth) never counts for that bone. Non-finite points
/// count as outside. The points are a muscle's vertices, or others that go with its surface
/// (surface_samples.hpp); they are told apart by their number.
///
/// Fast by what TrackedPoint keeps of each point and bone; frames may come in any order.
class PenetrationMeasure {
public:
    static constexpr double tolerance_mm = 0.1;

    /// bones: one solid per bone of the scene, in its rest frame; rest: V points of frame 0; rest_poses: the
    /// bones' poses in frame 0. threads: also for measure().
    PenetrationMeasure(std::vector<std::shared_ptr<const SolidQuery>> bones, double millimetres_per_unit,
                       const Points& rest, const std::vector<Pose>& rest_poses, int threads = 1);

    /// points: V, as at rest; poses: one per bone. The result is the same for every number of threads.
    Penetration measure(const Points& points, const std::vector<Pose>& poses);

    /// Depth of every point in the frame last measured, mm, V values, 0 when not penetrating.
    const std::vector<double>& depths_mm() const { return depths_mm_; }

private:
    struct Known : TrackedPoint {
        bool inside_at_rest = false;
    };
    double depth(const SolidQuery& bone, Known& known, const Vec3& q) const;

    std::vector<std::shared_ptr<const SolidQuery>> bones_;
    double millimetres_per_unit_;
    double far_; ///< distances are not looked up beyond this, scene units
    int threads_;
    std::vector<std::vector<Known>> known_; ///< by bone, by point
    std::vector<double> depths_mm_;
};

} // namespace fascicle
