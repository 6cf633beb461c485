#pragma once
// Keeps points inside a deforming surface, frame by frame, without any search structure to be rebuilt.

#include "fascicle/geometry/mesh_topology.hpp"
#include "fascicle/geometry/tri_mesh.hpp"

#include <cstdint>
#include <limits>
#include <span>

namespace fascicle {

/// Each held point knows the triangles that its shortest chords ended in at rest. It lay on the inner side of all of
/// their planes, and does so after every affine motion; where it does in a frame it is left alone. Where not, the
/// nearest place of the surface is sought by walking downhill from those triangles, and a point that is outside there
/// is put just inside. Local: nothing but the surface near the point is looked at.
class InsideHold {
public:
    static constexpr std::size_t ends_per_point = 12;

    InsideHold() = default;
    InsideHold(const TriMesh& surface, const MeshTopology& topology);

    /// Next point; ends: triangles, -1 for none after them (all -1: a point that is not held). margin: how far inside it
    /// is put, scene units.
    void add(const std::array<std::int32_t, ends_per_point>& ends, double margin);
    void reserve(std::size_t points);

    /// x as point `point` of a frame. Allocates nothing.
    Vec3 held(std::size_t point, const Vec3& x, std::span<const Vec3> surface) const {
        for (const std::int32_t t : ends_[point])
            if (t < 0)
                return x;
            else if (beyond(t, x, surface))
                return moved_in(point, x, surface);
        return x;
    }
    std::size_t bytes() const;

private:
    bool beyond(std::int32_t t, const Vec3& x, std::span<const Vec3> surface) const {
        const Tri& tri = triangles_[static_cast<std::size_t>(t)];
        const Vec3& a = surface[static_cast<std::size_t>(tri[0])];
        const Vec3& b = surface[static_cast<std::size_t>(tri[1])];
        const Vec3& c = surface[static_cast<std::size_t>(tri[2])];
        return (x - a).dot((b - a).cross(c - a)) > 0;
    }
    struct Foot {
        Vec3 point = Vec3::Zero(), normal = Vec3::Zero(); ///< normal: outwards, of any length
        double squared_distance = std::numeric_limits<double>::infinity();
    };
    int walk_down(int start, const Vec3& x, std::span<const Vec3> surface) const;
    Foot foot_around(int vertex, const Vec3& x, std::span<const Vec3> surface) const;
    Vec3 moved_in(std::size_t point, const Vec3& x, std::span<const Vec3> surface) const;

    std::vector<std::array<std::int32_t, ends_per_point>> ends_;
    std::vector<double> margins_;
    std::vector<Tri> triangles_;
    std::vector<std::uint32_t> fan_starts_; ///< triangles at a vertex
    std::vector<std::int32_t> fans_;
};

} // namespace fascicle
