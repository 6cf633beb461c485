#pragma once
// How far the vertices of a muscle are from the bones: exact, for looking at a single frame.

#include "fascicle/base/pose.hpp"
#include "fascicle/metrics/tracked_point.hpp"

#include <memory>
#include <vector>

namespace fascicle {

struct BoneDistance {
    double mm = 0; ///< signed: positive outside, negative inside
    int bone = -1; ///< the bone it belongs to; -1: none within reach
};

/// The smallest signed distance over all bones: of the nearest bone for a point outside of all, of the one it is
/// deepest inside of otherwise. Values beyond the reach are cut to +-reach. A non-finite point has +reach.
class BoneDistanceMeasure {
public:
    /// bones: one solid per bone of the scene, in its rest frame; reach_mm > 0, finite. threads: for measure().
    BoneDistanceMeasure(std::vector<std::shared_ptr<const SolidQuery>> bones, double millimetres_per_unit,
                        double reach_mm, int threads = 1);

    /// points: V positions, the same number in every call; poses: one per bone. V values, the same for every
    /// number of threads. What is kept between calls makes neighbouring frames fast; any order is right.
    std::vector<BoneDistance> measure(const Points& points, const std::vector<Pose>& poses);

private:
    std::vector<std::shared_ptr<const SolidQuery>> bones_;
    double millimetres_per_unit_, reach_mm_;
    int threads_;
    std::vector<std::vector<TrackedPoint>> tracked_; ///< by bone, by vertex
};

} // namespace fascicle
