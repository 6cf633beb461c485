#pragma once
// Whether a line segment meets a surface.

#include "fascicle/geometry/tri_mesh.hpp"

namespace fascicle {

/// Keeps its own copy of the corners. Queries are const, allocate nothing and may run on several threads.
class SegmentQuery {
public:
    SegmentQuery() = default;
    /// Indices in range, positions finite.
    explicit SegmentQuery(const TriMesh& mesh);

    /// Whether the segment from a to b has a point in common with a triangle. In doubt, within some 1e-12 of the size of
    /// things, it says yes, so "no" is certain: two points with nothing between them are on the same side of a closed
    /// surface. Not finite ends: yes. Cost: a few tree paths.
    bool meets(const Vec3& a, const Vec3& b) const;

private:
    struct Box {
        Vec3 low, high;
    };
    struct Child {
        Box box;
        int begin = 0, end = 0; ///< of corners_
        int node = -1;          ///< -1: a leaf
    };
    struct Node {
        std::array<Child, 4> children;
        int count = 0;
    };
    std::vector<Node> nodes_;
    std::vector<std::array<Vec3, 3>> corners_;
    double slack_ = 0; ///< 1e-12 of the largest coordinate
};

} // namespace fascicle
