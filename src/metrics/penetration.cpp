#include "fascicle/metrics/penetration.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/base/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle {

namespace {
constexpr double far_mm = 30.0;
constexpr std::size_t chunk = 256;
} // namespace

PenetrationMeasure::PenetrationMeasure(std::vector<std::shared_ptr<const SolidQuery>> bones,
                                       double millimetres_per_unit, const Points& rest,
                                       const std::vector<Pose>& rest_poses, int threads)
    : bones_(std::move(bones)), millimetres_per_unit_(millimetres_per_unit),
      far_(far_mm / millimetres_per_unit), threads_(threads),
      known_(bones_.size(), std::vector<Known>(rest.size())), depths_mm_(rest.size(), 0.0) {
    FASCICLE_ASSERT(rest_poses.size() == bones_.size());
    measure(rest, rest_poses);
    for (std::vector<Known>& list : known_)
        for (Known& known : list)
            known.inside_at_rest = known.radius >= 0.0 && known.inside;
    std::fill(depths_mm_.begin(), depths_mm_.end(), 0.0);
}

double PenetrationMeasure::depth(const SolidQuery& bone, Known& known, const Vec3& q) const {
    if (known.inside_at_rest || !q.allFinite())
        return 0.0;
    if (known.still_outside(q) || bone.beyond_box(q))
        return 0.0;
    const double d = known.look(bone, q, far_);
    return known.inside ? d : 0.0;
}

Penetration PenetrationMeasure::measure(const Points& points, const std::vector<Pose>& poses) {
    FASCICLE_ASSERT(points.size() == depths_mm_.size() && poses.size() == bones_.size());
    parallel_for(threads_, points.size(), chunk, [&](std::size_t begin, std::size_t end) {
        std::fill(depths_mm_.begin() + static_cast<std::ptrdiff_t>(begin),
                  depths_mm_.begin() + static_cast<std::ptrdiff_t>(end), 0.0);
        for (std::size_t b = 0; b < bones_.size(); ++b)
            for (std::size_t v = begin; v < end; ++v) {
                const double d = depth(*bones_[b], known_[b][v], poses[b].apply_inverse(points[v]));
                depths_mm_[v] = std::max(depths_mm_[v], millimetres_per_unit_ * d);
            }
    });
    Penetration result;
    for (const double d : depths_mm_) {
        result.count += d > tolerance_mm;
        result.max_mm = std::max(result.max_mm, d);
    }
    return result;
}

} // namespace fascicle
