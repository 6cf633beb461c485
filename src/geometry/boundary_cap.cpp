#include "boundary_cap.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace fascicle {

namespace {

struct DirectedEdge {
    int a, b;    // a < b
    int balance; // how much more often walked from a to b than from b to a
};

std::vector<DirectedEdge> unbalanced_edges(const std::vector<int>& same, const std::vector<Tri>& triangles) {
    // Into buckets by the lower end (counting sort), then each short bucket by the other end.
    const auto each_edge = [&](const auto& visit) {
        for (const Tri& t : triangles)
            for (std::size_t k = 0; k < 3; ++k) {
                const int a = same[static_cast<std::size_t>(t[k])];
                const int b = same[static_cast<std::size_t>(t[(k + 1) % 3])];
                if (a != b)
                    visit(DirectedEdge{std::min(a, b), std::max(a, b), a < b ? 1 : -1});
            }
    };
    std::vector<std::size_t> starts(same.size() + 1, 0);
    each_edge([&](const DirectedEdge& e) { ++starts[static_cast<std::size_t>(e.a) + 1]; });
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    std::vector<DirectedEdge> edges(starts.back());
    std::vector<std::size_t> next(starts.begin(), starts.end() - 1);
    each_edge([&](const DirectedEdge& e) { edges[next[static_cast<std::size_t>(e.a)]++] = e; });
    for (std::size_t v = 0; v < same.size(); ++v)
        std::sort(edges.begin() + static_cast<std::ptrdiff_t>(starts[v]),
                  edges.begin() + static_cast<std::ptrdiff_t>(starts[v + 1]),
                  [](const DirectedEdge& x, const DirectedEdge& y) { return x.b < y.b; });
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
    // By x alone first, whose values lie side by side; y and z decide among the few that are equal.
    struct Entry {
        double x;
        int vertex;
    };
    std::vector<Entry> order(points.size());
    for (std::size_t v = 0; v < points.size(); ++v)
        order[v] = {points[v].x(), static_cast<int>(v)};
    std::sort(order.begin(), order.end(), [](const Entry& a, const Entry& b) { return a.x < b.x; });
    const auto at = [&](const Entry& e) -> const Vec3& { return points[static_cast<std::size_t>(e.vertex)]; };
    std::vector<int> same(points.size());
    for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
        for (end = begin + 1; end < order.size() && order[end].x == order[begin].x; ++end) {
        }
        std::sort(order.begin() + static_cast<std::ptrdiff_t>(begin),
                  order.begin() + static_cast<std::ptrdiff_t>(end), [&](const Entry& a, const Entry& b) {
                      return std::tuple(at(a).y(), at(a).z(), a.vertex) <
                             std::tuple(at(b).y(), at(b).z(), b.vertex);
                  });
        for (std::size_t i = begin; i < end; ++i) {
            const bool again = i > begin && at(order[i]) == at(order[i - 1]);
            same[static_cast<std::size_t>(order[i].vertex)] =
                again ? same[static_cast<std::size_t>(order[i - 1].vertex)] : order[i].vertex;
        }
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
