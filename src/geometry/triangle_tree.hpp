#pragma once
// The grouping of triangles that the closest-point and the winding-number trees share: who lies with whom, no
// numbers.

#include "fascicle/base/types.hpp"

namespace fascicle {

/// Each node has 1 to 4 children; a child is a range [begin, end) of `order`, and either a leaf (node == -1)
/// or another node. Parents come before their children. Empty for no triangles.
struct TriangleTree {
    struct Child {
        int begin = 0;
        int end = 0;
        int node = -1;
    };
    struct Node {
        std::array<Child, 4> children;
        int count = 0;
    };
    std::vector<int> order; ///< triangle numbers, a permutation
    std::vector<Node> nodes;
};

/// Splits at the median of the centroids along the longest side of their box (at the next multiple of
/// leaf_size, so that all leaves but one are full), two levels at a time, until at most leaf_size are left. Depth <= log4(T) + 2 whatever the input; depends on the input alone (ties by
/// number).
TriangleTree build_triangle_tree(const Points& points, const std::vector<Tri>& triangles, int leaf_size);

} // namespace fascicle
