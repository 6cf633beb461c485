#include "fascicle/metrics/bone_distance.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/base/parallel.hpp"

#include <cmath>

namespace fascicle {

namespace {
constexpr std::size_t chunk = 256;
} // namespace

BoneDistanceMeasure::BoneDistanceMeasure(std::vector<std::shared_ptr<const SolidQuery>> bones,
                                         double millimetres_per_unit, double reach_mm, int threads)
    : bones_(std::move(bones)), millimetres_per_unit_(millimetres_per_unit), reach_mm_(reach_mm),
      threads_(threads), tracked_(bones_.size()) {
    FASCICLE_ASSERT(reach_mm > 0 && std::isfinite(reach_mm));
}

std::vector<BoneDistance> BoneDistanceMeasure::measure(const Points& points, const std::vector<Pose>& poses) {
    FASCICLE_ASSERT(poses.size() == bones_.size());
    const double reach = reach_mm_ / millimetres_per_unit_;
    for (std::vector<TrackedPoint>& list : tracked_) {
        FASCICLE_ASSERT(list.empty() || list.size() == points.size());
        list.resize(points.size());
    }
    std::vector<BoneDistance> result(points.size(), BoneDistance{reach_mm_, -1});
    parallel_for(threads_, points.size(), chunk, [&](std::size_t begin, std::size_t end) {
        for (std::size_t b = 0; b < bones_.size(); ++b)
            for (std::size_t v = begin; v < end; ++v) {
                if (!points[v].allFinite())
                    continue;
                TrackedPoint& tracked = tracked_[b][v];
                const double d = tracked.look(*bones_[b], poses[b].apply_inverse(points[v]), reach);
                const double mm = millimetres_per_unit_ * (tracked.inside ? -d : d);
                if (mm < result[v].mm)
                    result[v] = {mm, static_cast<int>(b)};
            }
    });
    return result;
}

} // namespace fascicle
