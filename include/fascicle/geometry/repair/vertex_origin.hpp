#pragma once
// Where the vertices of a changed mesh come from, and how values per vertex follow them.

#include "fascicle/base/types.hpp"

namespace fascicle {

/// sum of weights_k * value(vertices_k) over the old mesh's vertices; weights >= 0, sum 1; descending. -1: none.
struct VertexOrigin {
    std::array<int, 3> vertices{-1, -1, -1};
    std::array<double, 3> weights{0, 0, 0};

    static VertexOrigin of(int vertex) { return {{vertex, -1, -1}, {1, 0, 0}}; }
    /// The one with the largest weight: what a label or a membership follows.
    int nearest() const { return vertices[0]; }
};

/// The mean of several origins with these weights (any positive sum), cut down to its three largest parts.
VertexOrigin mean_origin(const std::vector<VertexOrigin>& origins, const std::vector<double>& weights);

/// Values with `width` numbers a vertex, row-major, on the new vertices: weighted means; where all values are whole numbers (labels,
/// identifiers) those of the nearest old vertex. A vertex without an origin gets 0.
std::vector<double> carried_values(const std::vector<VertexOrigin>& origins,
                                   const std::vector<double>& values, std::size_t width);

/// New vertices whose nearest old one is in `members` (ascending), ascending.
std::vector<int> carried_members(const std::vector<VertexOrigin>& origins, const std::vector<int>& members);

} // namespace fascicle
