#pragma once
// Points inside a muscle as fixed blends of surface vertices, so that they follow every frame.

#include "fascicle/anatomy/inside_hold.hpp"
#include "fascicle/geometry/mesh_topology.hpp"
#include "fascicle/geometry/tri_mesh.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

namespace fascicle {

/// A sparse matrix of weights, each row with sum 1, then a hold that puts back what the surface has passed over. It
/// follows every affine motion of the surface (that is no reflection) exactly. Plain data; const calls may run on several
/// threads.
class FibreCarrier {
public:
    FibreCarrier() = default;

    /// points[i] = sum_k w_ik surface[v_ik], each row summed in one fixed order, then InsideHold: the same bits always.
    /// surface: the V vertices it was bound to; points: point_count() places. Allocates nothing.
    void carry(std::span<const Vec3> surface, std::span<Vec3> points) const;

    std::size_t point_count() const { return starts_.size() - 1; }
    std::size_t weight_count() const { return weights_.size(); }
    /// Vertices of the surface it was bound to.
    std::size_t surface_vertices() const { return surface_vertices_; }
    std::size_t bytes() const;

    /// Vertices and weights of one point.
    std::span<const std::int32_t> vertices(std::size_t point) const {
        return {vertices_.data() + starts_[point], starts_[point + 1] - starts_[point]};
    }
    std::span<const double> weights(std::size_t point) const {
        return {weights_.data() + starts_[point], starts_[point + 1] - starts_[point]};
    }

private:
    friend class CarrierBuilder;
    std::vector<std::uint32_t> starts_{0};
    std::vector<std::int32_t> vertices_;
    std::vector<double> weights_;
    std::size_t surface_vertices_ = 0;
    InsideHold hold_;
};

/// Binds points in or on a closed surface at rest. A point on the surface (within 1e-9 of the surface's size) becomes
/// the barycentric blend of its triangle. Any other lies on chords of the surface in 13 fixed directions, and is the
/// mean of its places on them, short chords counting most (weight 1 / length^4): local, smooth, the surface's own
/// blend in the limit, and what bends least is what holds the point. A point outside, or where the surface is open, is
/// held by its nearest surface point and the chord inwards from there. Reproduces rest_points to 1e-9 of the
/// surface's size. topology is the surface's. Error naming the first point that is not finite, or an empty surface.
FibreCarrier bind_inside(const TriMesh& surface, const MeshTopology& topology,
                         std::span<const Vec3> rest_points, int threads = 1);

/// Moves points that are outside a closed surface, or nearer to it than `depth` (scene units), to that depth below
/// their nearest surface point, or half-way to the opposite side where it is thinner than two depths. Returns how
/// many moved. Points well inside keep their bits.
int move_inside(const TriMesh& surface, std::span<Vec3> points, double depth, int threads = 1);

} // namespace fascicle
