#include "fascicle/metrics/worst_vertex.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/metrics/bone_distance.hpp"
#include "fascicle/metrics/penetration.hpp"

#include <cmath>

namespace fascicle {

namespace {

using Solids = std::vector<std::shared_ptr<const SolidQuery>>;

constexpr double reach_mm = 1000.0; ///< nothing farther from all bones is of interest

/// The bone that a point is inside of by `depth` (scene units).
int bone_of_depth(const Solids& bones, const std::vector<Pose>& poses, const Vec3& point, double depth) {
    int best = -1;
    double error = 0;
    for (std::size_t b = 0; b < bones.size(); ++b) {
        const double d = -bones[b]->signed_distance(poses[b].apply_inverse(point));
        if (best < 0 || std::abs(d - depth) < error) {
            best = static_cast<int>(b);
            error = std::abs(d - depth);
        }
    }
    return best;
}

std::optional<WorstVertex> deepest(const Scene& scene, const Frame& rest, const Frame& frame,
                                   const Solids& bones, int threads) {
    const double mm = millimetres_per_unit(scene.unit);
    std::optional<WorstVertex> worst;
    for (std::size_t m = 0; m < scene.muscles.size(); ++m) {
        const Points& points = *frame.muscle_positions[m];
        PenetrationMeasure measure(bones, mm, *rest.muscle_positions[m], rest.bone_poses, threads);
        measure.measure(points, frame.bone_poses);
        for (std::size_t v = 0; v < points.size(); ++v) {
            const double depth = measure.depths_mm()[v];
            if (depth > PenetrationMeasure::tolerance_mm && (!worst || depth > worst->depth_mm))
                worst = WorstVertex{static_cast<int>(m), static_cast<int>(v), -1, depth, true, points[v]};
        }
    }
    if (worst)
        worst->bone = bone_of_depth(bones, frame.bone_poses, worst->point, worst->depth_mm / mm);
    return worst;
}

std::optional<WorstVertex> nearest(const Scene& scene, const Frame& frame,
                                   const std::vector<std::vector<Attachment>>& attachments,
                                   const Solids& bones, int threads) {
    std::optional<WorstVertex> worst;
    for (std::size_t m = 0; m < scene.muscles.size(); ++m) {
        const Points& points = *frame.muscle_positions[m];
        std::vector<bool> attached(points.size(), false);
        if (m < attachments.size())
            for (const Attachment& attachment : attachments[m])
                for (const int v : attachment.vertices)
                    attached[static_cast<std::size_t>(v)] = true;
        BoneDistanceMeasure measure(bones, millimetres_per_unit(scene.unit), reach_mm, threads);
        const std::vector<BoneDistance> distances = measure.measure(points, frame.bone_poses);
        for (std::size_t v = 0; v < points.size(); ++v) {
            const BoneDistance& d = distances[v];
            const bool candidate = !attached[v] && d.bone >= 0 && d.mm >= -PenetrationMeasure::tolerance_mm;
            if (candidate && (!worst || -d.mm > worst->depth_mm))
                worst =
                    WorstVertex{static_cast<int>(m), static_cast<int>(v), d.bone, -d.mm, false, points[v]};
        }
    }
    return worst;
}

} // namespace

std::optional<WorstVertex> worst_vertex(const Scene& scene, const Frame& rest, const Frame& frame,
                                        const std::vector<std::vector<Attachment>>& attachments,
                                        const std::vector<std::shared_ptr<const SolidQuery>>& bones,
                                        int threads) {
    FASCICLE_ASSERT(bones.size() == scene.bones.size() && frame.bone_poses.size() == bones.size());
    FASCICLE_ASSERT(frame.muscle_positions.size() == scene.muscles.size());
    std::optional<WorstVertex> worst = deepest(scene, rest, frame, bones, threads);
    return worst ? worst : nearest(scene, frame, attachments, bones, threads);
}

} // namespace fascicle
