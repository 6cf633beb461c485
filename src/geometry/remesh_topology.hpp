#pragma once
// A closed triangle mesh that can be changed: half-edges in threes, one per side of a triangle.

#include "fascicle/geometry/tri_mesh.hpp"

#include <vector>

namespace fascicle {

/// Half-edge h = 3 t + k runs from corner k of triangle t to corner k + 1 and has the triangle on its left.
/// Every half-edge has a twin: the mesh stays closed, manifold and oriented through every operation. Removed
/// triangles and vertices stay as gaps until compact().
class RemeshTopology {
public:
    explicit RemeshTopology(const TriMesh& mesh); ///< asserts that the mesh is closed, manifold and oriented

    int half_edges() const { return static_cast<int>(start_.size()); }
    int vertices() const { return static_cast<int>(positions.size()); }
    int triangles() const { return triangles_; }
    bool is_alive(int h) const { return start(h) >= 0; }
    bool is_vertex_alive(int v) const { return first_[static_cast<std::size_t>(v)] >= 0; }

    static int next(int h) { return h % 3 == 2 ? h - 2 : h + 1; }
    static int previous(int h) { return h % 3 == 0 ? h + 2 : h - 1; }
    int twin(int h) const { return twin_[static_cast<std::size_t>(h)]; }
    int start(int h) const { return start_[static_cast<std::size_t>(h)]; }
    int end(int h) const { return start(next(h)); }
    int opposite(int h) const { return start(previous(h)); } ///< third corner of the triangle on the left
    int first(int v) const { return first_[static_cast<std::size_t>(v)]; } ///< a half-edge that starts at v

    /// visit(h) for every half-edge that starts at v, once round it.
    template <typename Visit>
    void for_edges_from(int v, const Visit& visit) const {
        const int begin = first(v);
        int h = begin;
        do {
            visit(h);
            h = twin(previous(h));
        } while (h != begin);
    }
    int valence(int v) const;
    /// Whether more than `most` edges start at v: takes no longer at the hub of a wheel.
    bool has_more_edges(int v, int most) const;
    /// Whether an edge joins a and b. As long as the smaller of both fans.
    bool are_joined(int a, int b) const;

    const Vec3& position(int v) const { return positions[static_cast<std::size_t>(v)]; }
    double length(int h) const { return (position(start(h)) - position(end(h))).norm(); }

    /// New vertex at p on the edge of h; returns it. Two triangles become four.
    int split(int h, const Vec3& p);
    /// Whether the edge may be turned to join the two opposite corners: they are not joined yet and no end is
    /// left with fewer than three edges.
    bool may_flip(int h) const;
    void flip(int h);
    /// Whether the ends of h can become one vertex without change of topology (link condition).
    bool may_collapse(int h) const;
    /// The start of h goes into its end, which moves to p. Four triangles become two fewer.
    void collapse(int h, const Vec3& p);

    TriMesh compact() const;

    Points positions;

private:
    void glue(int a, int b) {
        twin_[static_cast<std::size_t>(a)] = b;
        twin_[static_cast<std::size_t>(b)] = a;
    }
    void set_start(int h, int v) {
        start_[static_cast<std::size_t>(h)] = v;
        first_[static_cast<std::size_t>(v)] = h;
    }

    std::vector<int> start_; // of each half-edge, -1 when removed
    std::vector<int> twin_;
    std::vector<int> first_; // of each vertex, -1 when unused
    int triangles_ = 0;
};

} // namespace fascicle
