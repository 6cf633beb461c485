#pragma once
// Who touches whom in a triangle list: edges, dihedrals, borders, neighbours, components. Built once, never
// changes.

#include "fascicle/base/bytes_of.hpp"
#include "fascicle/base/types.hpp"

#include <span>

namespace fascicle {

/// Undirected edge, a < b.
struct Edge {
    int a = -1;
    int b = -1;
    friend bool operator==(const Edge&, const Edge&) = default;
};

/// Interior manifold edge with its two triangles, in the vertex order of methods.md 1.1 "Dihedral, atan2
/// form": the first triangle is (p0, p2, p3), which walks the edge p2 -> p3, the second is (p1, p3, p2),
/// which walks it back. So with counter-clockwise triangles N1 = (p2-p0) x (p3-p0) and N2 = (p3-p1) x (p2-p1)
/// both point outwards, and theta = atan2(-(n1 x n2) . (p3-p2)/|p3-p2|, n1 . n2) is zero when flat, negative
/// over a ridge (convex, a cube's edges: -pi/2), positive in a valley. Always p2 < p3: (p2, p3) is edge
/// `edge`.
struct Dihedral {
    int p0, p1, p2, p3;
    int edge;
};

/// Works on any triangle list with indices in [0, vertex_count): open, non-manifold, inconsistent. A triangle
/// with a repeated index is passed over (it belongs to no edge, vertex or component). All lists are in a
/// fixed order that depends on the input alone: edges by (a, b), the rest ascending.
class MeshTopology {
public:
    MeshTopology() = default;
    /// FASCICLE_ASSERTs that every index is in range.
    MeshTopology(int vertex_count, const std::vector<Tri>& triangles);

    int vertex_count() const { return vertex_count_; }
    const std::vector<Edge>& edges() const { return edges_; }
    /// Edges with exactly two triangles that walk them in opposite directions.
    const std::vector<Dihedral>& dihedrals() const { return dihedrals_; }
    /// Indices of edges with exactly one triangle.
    const std::vector<int>& boundary_edges() const { return boundary_edges_; }
    /// Indices of edges with more than two triangles.
    const std::vector<int>& nonmanifold_edges() const { return nonmanifold_edges_; }
    /// Indices of edges with exactly two triangles that walk them in the same direction.
    const std::vector<int>& inconsistent_edges() const { return inconsistent_edges_; }

    /// Triangles of an edge, as half-edges 3 * triangle + corner: that triangle walks the edge from its
    /// corner `corner` to the next. Ascending.
    std::span<const int> edge_half_edges(int edge) const { return row(edge_starts_, edge_half_edges_, edge); }
    /// Triangles at a vertex, ascending.
    std::span<const int> vertex_triangles(int vertex) const {
        return row(triangle_starts_, vertex_triangles_, vertex);
    }
    /// Vertices joined to a vertex by an edge, ascending.
    std::span<const int> vertex_neighbours(int vertex) const {
        return row(neighbour_starts_, vertex_neighbours_, vertex);
    }

    /// Parts that hang together through shared vertices, numbered by their lowest vertex.
    int component_count() const { return component_count_; }
    /// Component of a vertex, or -1 when no triangle uses it.
    int vertex_component(int vertex) const { return vertex_component_[static_cast<std::size_t>(vertex)]; }

    /// Memory of all lists.
    std::size_t bytes() const {
        return bytes_of(edges_, edge_starts_, edge_half_edges_, dihedrals_, boundary_edges_,
                        nonmanifold_edges_, inconsistent_edges_, triangle_starts_, vertex_triangles_,
                        neighbour_starts_, vertex_neighbours_, vertex_component_);
    }

private:
    static std::span<const int> row(const std::vector<int>& starts, const std::vector<int>& values, int i) {
        const auto begin = static_cast<std::size_t>(starts[static_cast<std::size_t>(i)]);
        const auto end = static_cast<std::size_t>(starts[static_cast<std::size_t>(i) + 1]);
        return {values.data() + begin, end - begin};
    }
    void find_edges(const std::vector<Tri>& triangles);
    void classify_edges(const std::vector<Tri>& triangles);
    void find_vertex_rows(const std::vector<Tri>& triangles);
    void find_components();

    int vertex_count_ = 0;
    std::vector<Edge> edges_;
    std::vector<int> edge_starts_{0}, edge_half_edges_;
    std::vector<Dihedral> dihedrals_;
    std::vector<int> boundary_edges_, nonmanifold_edges_, inconsistent_edges_;
    std::vector<int> triangle_starts_{0}, vertex_triangles_;
    std::vector<int> neighbour_starts_{0}, vertex_neighbours_;
    std::vector<int> vertex_component_;
    int component_count_ = 0;
};

/// Whether two of a triangle's indices are equal.
inline bool has_repeated_index(const Tri& t) {
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

} // namespace fascicle
