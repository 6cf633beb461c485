#pragma once
// How deep muscles have gone into each other since rest: exact, on the surfaces of the frame.

#include "fascicle/geometry/bounding_box.hpp"
#include "fascicle/geometry/bvh.hpp"
#include "fascicle/geometry/winding_number.hpp"
#include "fascicle/scene/recording.hpp"

#include <optional>

namespace fascicle {

/// Depth of a vertex in another muscle: its distance to that muscle's surface when its winding number there
/// is above 0.5, else 0. What counts is the depth beyond the one at rest in the same muscle, so that muscles
/// whose meshes overlap at rest start at 0. Vertices that no triangle uses and non-finite ones are passed
/// over, and so is a whole muscle with a non-finite vertex as the one that others are inside of.
///
/// Only vertices in the box of the other muscle are looked at; muscles whose boxes are apart cost nothing
/// but the boxes.
class MuscleOverlapMeasure {
public:
    /// rest: frame 0. threads: also for measure().
    MuscleOverlapMeasure(ScenePtr scene, const Frame& rest, int threads = 1);

    /// One value per muscle, mm: the largest of its vertices over all other muscles, >= 0; 0 with one muscle.
    /// The result is the same for every number of threads.
    std::vector<double> measure(const Frame& frame);

private:
    /// The surface of one muscle in the frame under way. The tree and the winding number are made when the
    /// first vertex of another muscle is in the box.
    struct Surface {
        Points points;
        BoundingBox box; ///< empty: nothing can be inside
        TriangleBvh tree;
        std::optional<WindingNumber> winding; ///< of this frame, once it is needed
        bool has_tree = false;                ///< of some frame: refitted to this one
    };
    /// A vertex and its depth, scene units; only depths above 0 are listed. Ascending by vertex.
    using Depths = std::vector<std::pair<int, double>>;

    void take(const Frame& frame);
    void prepare(std::size_t muscle);
    Depths depths(std::size_t muscle, std::size_t other);

    ScenePtr scene_;
    int threads_;
    std::vector<std::vector<int>> used_; ///< by muscle: vertices that triangles use, ascending
    std::vector<Surface> surfaces_;
    std::vector<std::vector<Depths>> rest_; ///< [muscle][other]
};

} // namespace fascicle
