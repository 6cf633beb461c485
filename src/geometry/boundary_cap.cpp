#include "boundary_cap.hpp"

#include <algorithm>
#include <numeric>

namespace fascicle {

namespace {

struct DirectedEdge {
    int a, b;    // a < b
    int balance; // how much more often walked from a to b than from b to a
};

std::vector<DirectedEdge> unbalanced_edges(const std::vector<int>& same, const std::vector<Tri>& triangles) {
    std::vector<DirectedEdge> edges;
    edges.reserve(3 * triangles.size());
    for (const Tri& t : triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const int a = same[static_cast<std::size_t>(t[k])];
            const int b = same[static_cast<std::size_t>(t[(k + 1) % 3])];
            if (a != b)
                edges.push_back({std::min(a, b), std::max(a, b), a < b ? 1 : -1});
        }
    std::sort(edges.begin(), edges.end(), [](const DirectedEdge& x, const DirectedEdge& y) {
        return x.a != y.a ? x.a < y.a : x.b < y.b;
    });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < edges.size();) {
        DirectedEdge sum = edges[i];
        for (++i; i < edges.size() && edges[i].a == sum.a && edges[i].b == sum.b; ++i)
            sum.balance += edges[i].balance;
        if (sum.balance != 0)
            edges[kept++] = sum;
    }
    edges.resize(kept);
    return edges;
}

} // namespace

std::vector<int> coincident_vertices(const Points& points) {
    std::vector<int> order(points.size());
    std::iota(order.begin(), order.end(), 0);
    const auto at = [&](int v) -> const Vec3& { return points[static_cast<std::size_t>(v)]; };
    std::sort(order.begin(), order.end(), [&](int v, int w) {
        for (Eigen::Index k = 0; k < 3; ++k)
            if (at(v)[k] != at(w)[k])
                return at(v)[k] < at(w)[k];
        return v < w;
    });
    std::vector<int> same(points.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool again = i > 0 && at(order[i]) == at(order[i - 1]);
        same[static_cast<std::size_t>(order[i])] =
            again ? same[static_cast<std::size_t>(order[i - 1])] : order[i];
    }
    return same;
}

TriMesh boundary_cap(const Points& points, const std::vector<Tri>& triangles) {
    const std::vector<DirectedEdge> edges = unbalanced_edges(coincident_vertices(points), triangles);
    TriMesh cap;
    if (edges.empty())
        return cap;
    // Union-find over the vertices; the root is the lowest vertex of its set.
    std::vector<int> parent(points.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](int v) {
        while (parent[static_cast<std::size_t>(v)] != v) {
            int& up = parent[static_cast<std::size_t>(v)];
            up = parent[static_cast<std::size_t>(up)];
            v = up;
        }
        return v;
    };
    for (const DirectedEdge& e : edges) {
        const int a = root(e.a), b = root(e.b);
        parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    }
    std::vector<int> number(points.size(), -1); // cap vertex of a mesh vertex
    std::vector<int> apex(points.size(), -1);   // cap vertex of a set's root
    std::vector<int> members;                   // by cap vertex of an apex: how many points it is the mean of
    const auto vertex = [&](int v) {
        int& n = number[static_cast<std::size_t>(v)];
        if (n < 0) {
            n = cap.vertex_count();
            cap.positions.push_back(points[static_cast<std::size_t>(v)]);
        }
        return n;
    };
    for (const DirectedEdge& e : edges) {
        int& top = apex[static_cast<std::size_t>(root(e.a))];
        if (top < 0) {
            top = cap.vertex_count();
            cap.positions.push_back(Vec3::Zero());
            members.resize(cap.positions.size(), 0);
        }
        for (const int v : {e.a, e.b}) {
            cap.positions[static_cast<std::size_t>(top)] += points[static_cast<std::size_t>(v)];
            ++members[static_cast<std::size_t>(top)];
        }
        const int a = vertex(e.a), b = vertex(e.b);
        for (int i = 0; i < std::abs(e.balance); ++i)
            cap.triangles.push_back(e.balance > 0 ? Tri{b, a, top} : Tri{a, b, top});
    }
    for (std::size_t v = 0; v < members.size(); ++v)
        if (members[v] > 0)
            cap.positions[v] /= members[v];
    return cap;
}

} // namespace fascicle
