#include "fascicle/geometry/mesh_topology.hpp"

#include "fascicle/base/assert.hpp"

#include <algorithm>
#include <limits>

namespace fascicle {
namespace {

std::size_t z(int i) {
    return static_cast<std::size_t>(i);
}

/// Turns counts at [i + 1] into starts.
void sum_up(std::vector<int>& starts) {
    for (std::size_t i = 1; i < starts.size(); ++i)
        starts[i] += starts[i - 1];
}

} // namespace

MeshTopology::MeshTopology(int vertex_count, const std::vector<Tri>& triangles)
    : vertex_count_(vertex_count) {
    FASCICLE_ASSERT(vertex_count >= 0);
    FASCICLE_ASSERT(triangles.size() < z(std::numeric_limits<int>::max()) / 3);
    for (const Tri& t : triangles)
        for (const int v : t)
            FASCICLE_ASSERT(v >= 0 && v < vertex_count);
    find_edges(triangles);
    classify_edges(triangles);
    find_vertex_rows(triangles);
    find_components();
}

void MeshTopology::find_edges(const std::vector<Tri>& triangles) {
    // Half-edges into buckets by their lower vertex (counting sort), then each short bucket by the higher
    // vertex.
    struct HalfEdge {
        int high;
        int id;
    };
    std::vector<int> starts(z(vertex_count_) + 1, 0);
    const auto each_half_edge = [&](const auto& visit) {
        for (std::size_t t = 0; t < triangles.size(); ++t)
            if (!has_repeated_index(triangles[t]))
                for (std::size_t k = 0; k < 3; ++k) {
                    const int from = triangles[t][k], to = triangles[t][(k + 1) % 3];
                    visit(std::min(from, to), std::max(from, to), static_cast<int>(3 * t + k));
                }
    };
    each_half_edge([&](int low, int, int) { ++starts[z(low) + 1]; });
    sum_up(starts);
    std::vector<HalfEdge> buckets(z(starts.back()));
    std::vector<int> next(starts.begin(), starts.end() - 1);
    each_half_edge([&](int low, int high, int id) { buckets[z(next[z(low)]++)] = {high, id}; });

    edge_half_edges_.reserve(buckets.size());
    edge_starts_.clear();
    for (int low = 0; low < vertex_count_; ++low) {
        const auto begin = buckets.begin() + starts[z(low)];
        const auto end = buckets.begin() + starts[z(low) + 1];
        std::sort(begin, end, [](const HalfEdge& x, const HalfEdge& y) {
            return x.high != y.high ? x.high < y.high : x.id < y.id;
        });
        for (auto it = begin; it != end; ++it) {
            if (it == begin || it->high != (it - 1)->high) {
                edges_.push_back({low, it->high});
                edge_starts_.push_back(static_cast<int>(edge_half_edges_.size()));
            }
            edge_half_edges_.push_back(it->id);
        }
    }
    edge_starts_.push_back(static_cast<int>(edge_half_edges_.size()));
}

void MeshTopology::classify_edges(const std::vector<Tri>& triangles) {
    const auto corner = [&](int half_edge, int step) {
        return triangles[z(half_edge / 3)][z((half_edge + step) % 3)];
    };
    // Corner arithmetic: 3 * triangle is divisible by 3, so (half_edge + step) % 3 is the corner's own.
    for (int e = 0; e < static_cast<int>(edges_.size()); ++e) {
        const auto row = edge_half_edges(e);
        if (row.size() == 1) {
            boundary_edges_.push_back(e);
        } else if (row.size() > 2) {
            nonmanifold_edges_.push_back(e);
        } else {
            const bool first_up = corner(row[0], 0) == edges_[z(e)].a;
            const bool second_up = corner(row[1], 0) == edges_[z(e)].a;
            if (first_up == second_up) {
                inconsistent_edges_.push_back(e);
            } else {
                const int up = first_up ? row[0] : row[1], down = first_up ? row[1] : row[0];
                dihedrals_.push_back({corner(up, 2), corner(down, 2), edges_[z(e)].a, edges_[z(e)].b, e});
            }
        }
    }
}

void MeshTopology::find_vertex_rows(const std::vector<Tri>& triangles) {
    triangle_starts_.assign(z(vertex_count_) + 1, 0);
    for (const Tri& t : triangles)
        if (!has_repeated_index(t))
            for (const int v : t)
                ++triangle_starts_[z(v) + 1];
    sum_up(triangle_starts_);
    vertex_triangles_.resize(z(triangle_starts_.back()));
    std::vector<int> next(triangle_starts_.begin(), triangle_starts_.end() - 1);
    for (std::size_t t = 0; t < triangles.size(); ++t)
        if (!has_repeated_index(triangles[t]))
            for (const int v : triangles[t])
                vertex_triangles_[z(next[z(v)]++)] = static_cast<int>(t);

    neighbour_starts_.assign(z(vertex_count_) + 1, 0);
    for (const Edge& e : edges_) {
        ++neighbour_starts_[z(e.a) + 1];
        ++neighbour_starts_[z(e.b) + 1];
    }
    sum_up(neighbour_starts_);
    vertex_neighbours_.resize(z(neighbour_starts_.back()));
    next.assign(neighbour_starts_.begin(), neighbour_starts_.end() - 1);
    // Edges come by (a, b), so a vertex first receives its lower neighbours ascending, then its higher ones.
    for (const Edge& e : edges_)
        vertex_neighbours_[z(next[z(e.b)]++)] = e.a;
    for (const Edge& e : edges_)
        vertex_neighbours_[z(next[z(e.a)]++)] = e.b;
}

void MeshTopology::find_components() {
    vertex_component_.assign(z(vertex_count_), -1);
    std::vector<int> stack;
    for (int seed = 0; seed < vertex_count_; ++seed) {
        if (vertex_component_[z(seed)] >= 0 || vertex_neighbours(seed).empty())
            continue;
        vertex_component_[z(seed)] = component_count_;
        stack.assign(1, seed);
        while (!stack.empty()) {
            const int v = stack.back();
            stack.pop_back();
            for (const int n : vertex_neighbours(v))
                if (vertex_component_[z(n)] < 0) {
                    vertex_component_[z(n)] = component_count_;
                    stack.push_back(n);
                }
        }
        ++component_count_;
    }
}

} // namespace fascicle
