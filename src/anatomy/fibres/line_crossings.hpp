#pragma once
// Where the lines of one direction cross a surface: triangles sorted into a grid across the direction.

#include "fascicle/geometry/tri_mesh.hpp"

#include <cstdint>
#include <limits>

namespace fascicle {

/// A crossing ahead of or behind a point. distance: signed, along the direction; weights: of the triangle's corners.
struct LineCrossing {
    int triangle = -1; ///< -1: none
    double distance = std::numeric_limits<double>::infinity();
    Vec3 weights = Vec3::Zero();
};

/// The two crossings next to a point on each side; `second` is the one behind the first.
struct LineNeighbours {
    LineCrossing ahead, ahead_second, behind, behind_second;
    /// Winding number of a closed surface around the point: crossings ahead where the line leaves minus those where it
    /// enters.
    int winding = 0;
};

/// Borrows the mesh. Queries are const and allocate nothing. Which side of an edge a line passes is decided once for
/// both triangles at it, so that no line slips through between them.
class LineCrossings {
public:
    /// direction: unit. Coordinates finite, indices in range.
    LineCrossings(const TriMesh& mesh, const Vec3& direction);

    LineNeighbours at(const Vec3& p) const;
    const Vec3& direction() const { return axes_[2]; }

private:
    template <typename Visit>
    void for_crossings(const Vec3& p, const Visit& visit) const;

    const TriMesh* mesh_;
    std::array<Vec3, 3> axes_; ///< two across, then the direction
    Points flat_;              ///< vertices in those axes
    Vec2 low_ = Vec2::Zero();
    double cell_ = 1;
    int columns_ = 1, rows_ = 1;
    std::vector<std::uint32_t> starts_;
    std::vector<std::int32_t> triangles_;
};

/// 13 directions, one for each pair of opposite faces, edges and corners of a cube that is turned off the axes, so
/// that no edge of a mesh drawn along the axes runs along one of them.
const std::array<Vec3, 13>& chord_directions();

} // namespace fascicle
