#include "solver/classic/voxel_grid.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace fascicle::classic {

namespace {

// In voxels: what a coordinate may be off by.
constexpr double rounding = 1e-9;

/// Unit vector, or zero when too short: a triangle without area then borders every cell of its box.
Vec3 unit_or_zero(const Vec3& v) {
    const double length = v.norm();
    return length > 1e-10 ? Vec3(v / length) : Vec3(Vec3::Zero());
}

} // namespace

VoxelGrid::VoxelGrid(const TriMesh& mesh, bool meant)
    : meant_(meant), cells_(static_cast<std::size_t>(size) * size * size, std::uint8_t{0}) {
    Vec3 lower = Vec3::Constant(std::numeric_limits<double>::max());
    Vec3 upper = -lower;
    for (const Tri& t : mesh.triangles) {
        for (const int v : t) {
            lower = lower.cwiseMin(mesh.positions[static_cast<std::size_t>(v)]);
            upper = upper.cwiseMax(mesh.positions[static_cast<std::size_t>(v)]);
        }
    }
    if (mesh.triangles.empty())
        return; // nothing inside
    const int covering = meant_ ? size - 4 : size;
    for (int k = 0; k < 3; ++k) {
        const double extent = upper[k] - lower[k];
        cell_[k] = extent > 0.0 ? extent / covering : 1.0;
    }
    lower_ = meant_ ? Vec3(lower - 2.0 * cell_) : lower;
    for (const Tri& t : mesh.triangles)
        mark_border(mesh.positions[static_cast<std::size_t>(t[0])],
                    mesh.positions[static_cast<std::size_t>(t[1])],
                    mesh.positions[static_cast<std::size_t>(t[2])]);
    flood();
}

void VoxelGrid::mark_border(const Vec3& a, const Vec3& b, const Vec3& c) {
    const std::array<Vec3, 3> corner{to_voxels(a), to_voxels(b), to_voxels(c)};
    const Vec3 plane = unit_or_zero((corner[1] - corner[0]).cross(corner[2] - corner[0]));
    const Vec3 normal = meant_ ? plane : unit_or_zero((b - a).cross(c - a));
    std::array<Vec3, 3> side;
    for (std::size_t i = 0; i < 3; ++i)
        side[i] = unit_or_zero((corner[(i + 1) % 3] - corner[i]).cross(normal));
    const double diagonal = std::sqrt(3.0) + 1e-3;
    const double side_reach = meant_ ? 0.5 * diagonal : diagonal;
    const Vec3 probe_shift = meant_ ? Vec3(Vec3::Constant(0.5)) : Vec3(Vec3::Zero());

    const Vec3 lowest = corner[0].cwiseMin(corner[1]).cwiseMin(corner[2]);
    const Vec3 highest = corner[0].cwiseMax(corner[1]).cwiseMax(corner[2]);
    std::array<int, 3> first{}, last{};
    for (int k = 0; k < 3; ++k) {
        const auto i = static_cast<std::size_t>(k);
        // published: from floor(lowest) while index < highest + 1, so a cell beyond the triangle's box belongs to it.
        // meant: every cell that touches the box.
        const double from = meant_ ? std::ceil(lowest[k] - rounding) - 1.0 : std::floor(lowest[k]);
        const double to = meant_ ? std::floor(highest[k] + rounding) : std::ceil(highest[k] + 1.0) - 1.0;
        first[i] = std::clamp(static_cast<int>(from), 0, size - 1);
        last[i] = std::clamp(static_cast<int>(to), 0, size - 1);
    }
    for (int x = first[0]; x <= last[0]; ++x) {
        for (int y = first[1]; y <= last[1]; ++y) {
            for (int z = first[2]; z <= last[2]; ++z) {
                const Vec3 probe = Vec3(x, y, z) + probe_shift;
                bool touches = std::abs(plane.dot(corner[0] - probe)) <= 0.5 * diagonal;
                for (std::size_t i = 0; i < 3 && touches; ++i)
                    touches = side[i].dot(probe - corner[i]) <= side_reach;
                if (touches)
                    cells_[index(x, y, z)] |= border_bit;
            }
        }
    }
}

void VoxelGrid::flood() {
    for (std::uint8_t& cell : cells_)
        cell |= inside_bit;
    const int least = meant_ ? 0 : 1; // published: a step never ends on index 0
    std::vector<std::array<int, 3>> open{{0, 0, 0}};
    while (!open.empty()) {
        const std::array<int, 3> at = open.back();
        open.pop_back();
        std::uint8_t& cell = cells_[index(at[0], at[1], at[2])];
        if (cell != inside_bit) // seen, or border
            continue;
        cell = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (const int step : {-1, 1}) {
                std::array<int, 3> next = at;
                next[axis] += step;
                if (next[axis] >= least && next[axis] < size)
                    open.push_back(next);
            }
        }
    }
}

bool VoxelGrid::inside(const Vec3& voxels) const {
    for (int k = 0; k < 3; ++k) {
        if (!(voxels[k] >= 0.0 && voxels[k] < size)) // NaN is outside
            return false;
    }
    return inside(static_cast<int>(voxels[0]), static_cast<int>(voxels[1]), static_cast<int>(voxels[2]));
}

} // namespace fascicle::classic
