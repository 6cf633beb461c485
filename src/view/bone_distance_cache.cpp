#include "view/bone_distance_cache.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/base/parallel.hpp"

#include <algorithm>

namespace fascicle::view {

namespace {

bool same(const std::vector<Pose>& a, const std::vector<Pose>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Pose& x, const Pose& y) {
        return x.rotation == y.rotation && x.translation == y.translation;
    });
}

} // namespace

std::shared_ptr<const SolidQuery> BoneDistanceCache::solid(std::size_t bone, const MeshPtr& mesh) {
    if (bone >= solids_.size())
        solids_.resize(bone + 1);
    auto& [made_of, query] = solids_[bone];
    if (!query || made_of != mesh) {
        query = mesh ? std::make_shared<const SolidQuery>(*mesh) : std::make_shared<const SolidQuery>();
        made_of = mesh;
        ++computed_;
    }
    return query;
}

BoneDistances BoneDistanceCache::distances(const Scene& scene, std::size_t muscle, const PointsPtr& points,
                                           const std::vector<Pose>& poses, double reach) {
    FASCICLE_ASSERT(points != nullptr && poses.size() == scene.bones.size());
    if (muscle >= muscles_.size())
        muscles_.resize(muscle + 1);
    Entry& entry = muscles_[muscle];
    std::vector<MeshPtr> bones;
    for (const Bone& bone : scene.bones)
        bones.push_back(bone.mesh);
    const double mm = millimetres_per_unit(scene.unit);
    const bool same_size = entry.points != nullptr && entry.points->size() == points->size();
    if (!entry.measure || entry.bones != bones || entry.millimetres_per_unit != mm || entry.reach != reach ||
        !same_size) {
        std::vector<std::shared_ptr<const SolidQuery>> solids;
        for (std::size_t b = 0; b < bones.size(); ++b)
            solids.push_back(solid(b, bones[b]));
        entry = {};
        entry.bones = bones;
        entry.millimetres_per_unit = mm;
        entry.reach = reach;
        entry.measure =
            std::make_unique<BoneDistanceMeasure>(std::move(solids), mm, reach, hardware_threads());
    }
    if (!entry.distances || entry.points != points || !same(entry.poses, poses)) {
        entry.distances =
            std::make_shared<const std::vector<BoneDistance>>(entry.measure->measure(*points, poses));
        entry.points = points;
        entry.poses = poses;
        ++computed_;
    }
    return entry.distances;
}

} // namespace fascicle::view
