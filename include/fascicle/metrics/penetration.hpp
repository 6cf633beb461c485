#pragma once
// Which vertices of a muscle are inside a bone that they were not inside of at rest, and how deep: exact.

#include "fascicle/base/pose.hpp"
#include "fascicle/geometry/solid_query.hpp"

#include <memory>

namespace fascicle {

struct Penetration {
    int vertices = 0;  ///< deeper than the tolerance inside at least one bone
    double max_mm = 0; ///< greatest depth, tolerated ones included; 0 when no vertex is inside
};

/// Depth = distance to the bone's surface of a vertex inside (winding number > 0.5), in the bone's own frame,
/// 0 outside. A vertex inside a bone at rest (by any depth) never counts for that bone. Non-finite vertices
/// count as outside.
///
/// Fast because of what it keeps of each vertex and bone: a point q of the bone's frame, its side, and the
/// radius of a ball around it that lies on that side (SolidSide). While the vertex stays in the ball of an
/// outside point nothing is to do; when the balls of the old and the new point overlap the side is the same
/// and no winding number is needed. Both are true for any two points, so that frames may come in any order.
class PenetrationMeasure {
public:
    static constexpr double tolerance_mm = 0.1;

    /// bones: one solid per bone of the scene, in its rest frame; rest: V positions of frame 0; rest_poses:
    /// the bones' poses in frame 0. threads: also for measure().
    PenetrationMeasure(std::vector<std::shared_ptr<const SolidQuery>> bones, double millimetres_per_unit,
                       const Points& rest, const std::vector<Pose>& rest_poses, int threads = 1);

    /// points: V positions; poses: one per bone. The result is the same for every number of threads.
    Penetration measure(const Points& points, const std::vector<Pose>& poses);

    /// Depth of every vertex in the frame last measured, mm, V values, 0 when not penetrating.
    const std::vector<double>& depths_mm() const { return depths_mm_; }

private:
    struct Known {
        Vec3 point = Vec3::Zero(); ///< in the bone's frame
        double radius = -1;        ///< < 0: nothing known yet
        int triangle = -1;         ///< nearest, a hint
        bool inside = false;
        bool inside_at_rest = false;
    };
    double depth(const SolidQuery& bone, Known& known, const Vec3& q) const;

    std::vector<std::shared_ptr<const SolidQuery>> bones_;
    double millimetres_per_unit_;
    double far_; ///< distances are not looked up beyond this, scene units
    int threads_;
    std::vector<std::vector<Known>> known_; ///< by bone, by vertex
    std::vector<double> depths_mm_;
};

} // namespace fascicle
