#pragma once
// Signed distance to a solid on a regular grid in the solid's rest frame.

#include "fascicle/base/job_control.hpp"
#include "fascicle/base/large_array.hpp"
#include "fascicle/geometry/tri_mesh.hpp"

#include <optional>
#include <span>
#include <string_view>

namespace fascicle {

/// Value and gradient of the trilinear interpolant. gradient is that of the interpolant, not normalised; zero
/// where all eight nodes are saturated and outside of the grid.
struct DistanceSample {
    double value = 0;
    Vec3 gradient = Vec3::Zero();
};

struct DistanceGridOptions {
    double spacing = 1.0; ///< wanted h, scene units, > 0; made coarser when the grid would exceed max_nodes
    double saturation =
        8.0; ///< scene units, > 0; values are clamped to +-saturation: a lower bound of the distance's size
    std::size_t max_nodes = std::size_t{64} << 20; ///< at least 8
    int threads = 1;
};

/// Exact distances at the nodes, negative inside, by generalised winding number > 0.5: right for closed
/// surfaces of any topology, doubled vertices and non-manifold edges, and for small holes. Conservative: the
/// interpolant is <= 0 on the whole surface, so that the set value >= 0 holds no surface point. To that end
/// the surface is sampled every h / 4, and each node is lowered by the largest positive value (and a small
/// allowance for what lies between the samples) in its cells. Hence value <= distance at every node, and
/// -value <= depth + correction. Between nodes the interpolant exceeds the distance by at most the h sqrt(3)
/// of any interpolant, on smooth parts by about h^2 / (4 R).
class DistanceGrid {
public:
    /// The mesh must be usable (indices in range, finite positions). No triangles: saturated everywhere.
    /// Throws Cancelled. The result is the same for every number of threads.
    DistanceGrid(const TriMesh& mesh, const DistanceGridOptions& options, const JobControl& control = {});

    /// Any point, also non-finite ones. Outside of the grid's box the value is the saturation distance.
    DistanceSample sample(const Vec3& p) const {
        Cell cell;
        if (!locate(p, cell))
            return {saturation_, Vec3::Zero()};
        return interpolate(cell);
    }
    /// sample(p).value, to the last bit.
    double value(const Vec3& p) const {
        Cell cell;
        if (!locate(p, cell))
            return saturation_;
        const auto [x, y, z] = cell.share;
        const double v00 = cell.at[0] + x * (cell.at[1] - cell.at[0]);
        const double v10 = cell.at[2] + x * (cell.at[3] - cell.at[2]);
        const double v01 = cell.at[4] + x * (cell.at[5] - cell.at[4]);
        const double v11 = cell.at[6] + x * (cell.at[7] - cell.at[6]);
        const double v0 = v00 + y * (v10 - v00), v1 = v01 + y * (v11 - v01);
        return v0 + z * (v1 - v0);
    }

    double spacing() const { return spacing_; }
    double saturation() const { return saturation_; }
    const std::array<int, 3>& nodes() const { return nodes_; }
    /// Position of node (0, 0, 0); node (i, j, k) is at low() + spacing() (i, j, k).
    const Vec3& low() const { return low_; }
    /// Value of node (i, j, k).
    double node_value(int i, int j, int k) const { return values_[index(i, j, k)]; }
    /// All node values, x fastest.
    std::span<const float> values() const { return values_; }
    /// Largest and mean lowering of nodes near the surface (corners of cells that the surface passes), scene
    /// units: how far the zero set stands off the surface.
    double correction_max() const { return correction_max_; }
    double correction_mean() const { return correction_mean_; }
    std::size_t bytes() const { return values_.size() * sizeof(float); }
    /// The node values themselves, x fastest: node (i, j, k) is data()[i + step_y() j + step_z() k].
    const float* data() const { return values_.data(); }
    std::size_t step_y() const { return step_y_; }
    std::size_t step_z() const { return step_z_; }

private:
    DistanceGrid() = default; // for decode_grid, which fills it
    friend std::optional<DistanceGrid> decode_grid(std::string_view bytes, std::size_t max_nodes,
                                                   int threads);
    struct Cell {
        std::array<double, 8> at;    ///< corner values, x fastest
        std::array<double, 3> share; ///< position within the cell, each in [0, 1)
    };
    std::size_t index(int i, int j, int k) const {
        return static_cast<std::size_t>(i) + step_y_ * static_cast<std::size_t>(j) +
               step_z_ * static_cast<std::size_t>(k);
    }
    DistanceSample interpolate(const Cell& cell) const {
        const auto [x, y, z] = cell.share;
        const double d00 = cell.at[1] - cell.at[0], d10 = cell.at[3] - cell.at[2];
        const double d01 = cell.at[5] - cell.at[4], d11 = cell.at[7] - cell.at[6];
        const double v00 = cell.at[0] + x * d00, v10 = cell.at[2] + x * d10;
        const double v01 = cell.at[4] + x * d01, v11 = cell.at[6] + x * d11;
        const double v0 = v00 + y * (v10 - v00), v1 = v01 + y * (v11 - v01);
        const double dx0 = d00 + y * (d10 - d00), dx1 = d01 + y * (d11 - d01);
        const double dy0 = v10 - v00, dy1 = v11 - v01;
        return {v0 + z * (v1 - v0),
                per_spacing_ * Vec3(dx0 + z * (dx1 - dx0), dy0 + z * (dy1 - dy0), v1 - v0)};
    }
    /// Lowest corner of the cell of p; false outside of the grid and for NaN.
    bool locate_corner(const Vec3& p, std::size_t& corner, std::array<double, 3>& share) const {
        const double x = (p.x() - low_.x()) * per_spacing_;
        const double y = (p.y() - low_.y()) * per_spacing_;
        const double z = (p.z() - low_.z()) * per_spacing_;
        if (!(x >= 0.0 && y >= 0.0 && z >= 0.0 && x < nodes_[0] - 1 && y < nodes_[1] - 1 &&
              z < nodes_[2] - 1))
            return false;
        const int i = static_cast<int>(x), j = static_cast<int>(y), k = static_cast<int>(z);
        corner = index(i, j, k);
        share = {x - i, y - j, z - k};
        return true;
    }
    void load_corners(std::size_t corner, Cell& cell) const {
        const float* v = values_.data() + corner;
        cell.at = {v[0],       v[1],           v[step_y_],           v[step_y_ + 1],
                   v[step_z_], v[step_z_ + 1], v[step_y_ + step_z_], v[step_y_ + step_z_ + 1]};
    }
    bool locate(const Vec3& p, Cell& cell) const {
        std::size_t corner = 0;
        if (!locate_corner(p, corner, cell.share))
            return false;
        load_corners(corner, cell);
        return true;
    }
    void choose_shape(const TriMesh& mesh, const DistanceGridOptions& options);
    void fill_distances(const TriMesh& mesh, int threads, const JobControl& control);
    void set_signs(const TriMesh& mesh, int threads, const JobControl& control);
    void make_conservative(const TriMesh& mesh, int threads, const JobControl& control);

    double spacing_ = 1;
    double per_spacing_ = 1;
    double saturation_ = 8;
    std::array<int, 3> nodes_{};
    std::size_t step_y_ = 0, step_z_ = 0;
    Vec3 low_ = Vec3::Zero();
    LargeArray<float> values_; ///< x fastest
    double correction_max_ = 0;
    double correction_mean_ = 0;
};

} // namespace fascicle
