#pragma once
// Muscles that touch each other: for every frame, each vertex near another muscle gets a plane that it must not cross,
// taken from the nearest point of the other's surface. Both sides of a contact get theirs from the same frame, so each stays on
// its own side, and both planes move as the bones are expected to take the two surfaces along. Source: methods notes 5.4, last
// point, with planes of a frame instead of point-triangle pairs.

#include "fascicle/geometry/bvh.hpp"
#include "fascicle/geometry/mesh_topology.hpp"
#include "fascicle/scene/scene.hpp"
#include "fascicle/simulation/prepare.hpp"

namespace fascicle {

class MuscleContact {
public:
    /// At rest. A vertex that lies inside another muscle there, or nearer to it than the contact offset, may stay as it is:
    /// overlaps of a segmentation are kept, not mended.
    MuscleContact(const Scene& scene, const PreparedScene& prepared);

    /// A vertex that no bone holds any more.
    void release(std::size_t muscle, int vertex) {
        muscles_[muscle].body_of_vertex[static_cast<std::size_t>(vertex)] = -1;
    }

    bool empty() const { return muscles_.size() < 2; }
    /// Planes of every muscle for the frame in which bone b moves from from[b] to to[b], the muscles being at the positions given.
    /// Result: one list a muscle, by vertex; valid until the next call.
    const std::vector<std::vector<PointPlane>>& planes(const std::vector<const Points*>& positions,
                                                       std::span<const Pose> from, std::span<const Pose> to,
                                                       int threads);

private:
    struct Muscle {
        MeshPtr surface;
        std::vector<int> body_of_vertex;
        std::vector<double> carry;
        MeshTopology topology;
        TriangleBvh tree;
        Points last;        ///< where it is
        double travel = 0;  ///< the furthest that a vertex has moved since the call before
        bool stale = false; ///< the tree is that of an earlier call
    };
    /// One muscle's vertices against another's surface.
    struct Pair {
        std::size_t muscle = 0, other = 0;
        std::vector<double> slack; ///< by vertex: both together may still move so far before it can come near
        std::vector<double> least; ///< by vertex: signed distance that it must keep
        std::vector<int> hint;     ///< by vertex: the triangle that was nearest
    };
    Vec3 carried(const Muscle& muscle, int vertex, const Vec3& x, std::span<const Pose> from,
                 std::span<const Pose> to) const;
    void find_planes(Pair& pair, std::span<const Pose> from, std::span<const Pose> to, int threads);

    std::vector<Muscle> muscles_;
    std::vector<Pair> pairs_;
    std::vector<std::vector<PointPlane>> planes_;
    std::vector<PointPlane> found_; ///< scratch: by vertex of a pair
    double offset_ = 0, near_ = 0, reach_ = 0;
};

} // namespace fascicle
