#pragma once
// Inside tests for a muscle at rest, and moving points in.

#include "anatomy/fibres/line_crossings.hpp"
#include "fascicle/geometry/bvh.hpp"
#include "fascicle/geometry/vertex_normals.hpp"

#include <cmath>
#include <span>

namespace fascicle {

/// Borrows the surface. Queries are const and may run on several threads.
class MuscleInside {
public:
    explicit MuscleInside(const TriMesh& surface);

    /// Winding number > 0 by crossings along three lines; the majority counts, which matters near holes only.
    bool inside(const Vec3& p) const;
    /// Distance to the surface, negative outside.
    double depth(const Vec3& p) const;
    /// See move_inside(); returns whether p moved.
    bool move(Vec3& p, double depth) const;
    int move_all(std::span<Vec3> points, double depth, int threads) const;
    const TriangleBvh& tree() const { return tree_; }

private:
    const TriMesh* surface_;
    TriangleBvh tree_;
    std::vector<LineCrossings> lines_;
    Points normals_;
};

} // namespace fascicle
