#pragma once
// A solid as 64^3 voxels in its rest frame: what the published program collides with (notes 1.3).

#include "fascicle/geometry/tri_mesh.hpp"

#include <cstdint>

namespace fascicle::classic {

/// published, quirks included:
/// - the solid's bounding box without padding, cut into 64 cells along each axis, whatever the proportions;
/// - a cell is border when a triangle whose box covers it (one cell further on the upper side) has its plane
/// within
///   half a diagonal (sqrt(3) + 1e-3)/2 of the cell's lower corner (not its centre: half a voxel of bias),
///   and the corner lies no more than a whole diagonal outside each of the three planes through its edges.
///   Distances are measured in voxels; the edge planes are built from the voxel-space edge and the normal in
///   real space;
/// - outside is what a flood fill from cell (0, 0, 0) reaches through faces, never stepping onto index 0;
/// when that
///   cell is border, everything is inside. Border cells count as inside.
/// meant: two free cells on every side of the box, only cells that touch the triangle's box, distance from the cell's centre, edge planes within half a
/// diagonal and built in voxel space alone, flood fill through every face from the corner, which is always
/// free.
class VoxelGrid {
public:
    static constexpr int size = 64;

    /// A box of no extent along an axis gets cells of unit length there.
    VoxelGrid(const TriMesh& mesh, bool meant);

    /// Continuous voxel coordinates of a point in the rest frame, and back. Cell i spans [i, i + 1).
    Vec3 to_voxels(const Vec3& point) const { return (point - lower_).cwiseQuotient(cell_); }
    Vec3 from_voxels(const Vec3& voxels) const { return voxels.cwiseProduct(cell_) + lower_; }
    const Vec3& cell() const { return cell_; }

    bool border(int x, int y, int z) const { return cells_[index(x, y, z)] & border_bit; }
    bool inside(int x, int y, int z) const { return cells_[index(x, y, z)] & inside_bit; }
    /// Whether the cell around a voxel coordinate is inside. Beyond the grid: no. (The program turns negative
    /// numbers into unsigned ones there, which is undefined; what it means is "no".)
    bool inside(const Vec3& voxels) const;

private:
    static constexpr std::uint8_t inside_bit = 1, border_bit = 2;
    static std::size_t index(int x, int y, int z) {
        return static_cast<std::size_t>((x * size + y) * size + z);
    }
    void mark_border(const Vec3& a, const Vec3& b, const Vec3& c);
    void flood();

    bool meant_;
    Vec3 lower_ = Vec3::Zero();
    Vec3 cell_ = Vec3::Ones();
    std::vector<std::uint8_t> cells_;
};

} // namespace fascicle::classic
