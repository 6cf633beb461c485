#pragma once
// Distances of muscles' vertices to the bones, exact, kept from one picture to the next.

#include "fascicle/metrics/bone_distance.hpp"
#include "fascicle/scene/recording.hpp"

namespace fascicle::view {

using BoneDistances = std::shared_ptr<const std::vector<BoneDistance>>;

/// Keeps the trees of the bones (by mesh), and of each muscle the distances of the last frame asked for, with what
/// makes its neighbours fast. Nothing is made before it is asked for. Not thread-safe.
class BoneDistanceCache {
public:
    /// Distances beyond this are cut, where nothing else is asked for.
    static constexpr double reach_mm = 10.0;

    /// points: of the muscle; poses: one per bone of the scene. The same array as before when nothing has changed.
    /// Bones without a mesh are nowhere. reach > 0, mm: distances beyond are cut.
    BoneDistances distances(const Scene& scene, std::size_t muscle, const PointsPtr& points,
                            const std::vector<Pose>& poses, double reach = reach_mm);

    /// How many arrays and trees were computed so far.
    int computed() const { return computed_; }

private:
    struct Entry {
        std::vector<MeshPtr> bones; ///< that `measure` is about
        double millimetres_per_unit = 0, reach = 0;
        std::unique_ptr<BoneDistanceMeasure> measure;
        PointsPtr points;
        std::vector<Pose> poses;
        BoneDistances distances;
    };
    std::shared_ptr<const SolidQuery> solid(std::size_t bone, const MeshPtr& mesh);

    std::vector<std::pair<MeshPtr, std::shared_ptr<const SolidQuery>>> solids_; ///< by bone
    std::vector<Entry> muscles_;
    int computed_ = 0;
};

} // namespace fascicle::view
