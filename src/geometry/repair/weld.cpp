// Vertices and triangles that are there more than once.
#include "fascicle/geometry/mesh_topology.hpp"
#include "geometry/repair/steps.hpp"

#include <algorithm>
#include <numeric>

namespace fascicle::detail {

namespace {

/// Marks the ends of edges with one triangle.
std::vector<int> border_vertices(const MeshTopology& topology) {
    std::vector<int> border;
    for (const int e : topology.boundary_edges()) {
        border.push_back(topology.edges()[at(e)].a);
        border.push_back(topology.edges()[at(e)].b);
    }
    std::sort(border.begin(), border.end());
    border.erase(std::unique(border.begin(), border.end()), border.end());
    return border;
}

std::vector<Tri> renamed(const std::vector<Tri>& triangles, const std::vector<int>& name) {
    std::vector<Tri> out = triangles;
    for (Tri& t : out)
        for (int& v : t)
            v = name[at(v)];
    return out;
}

/// Weld of the border: for each vertex who stands for it.
std::vector<int> border_names(const TriMesh& mesh, const MeshTopology& topology,
                              const std::vector<int>& border, double tolerance, double joined_limit) {
    Points places;
    for (const int v : border)
        places.push_back(mesh.positions[at(v)]);
    const std::vector<int> stands = near_vertices(places, tolerance);
    std::vector<int> name(mesh.positions.size());
    std::iota(name.begin(), name.end(), 0);
    for (std::size_t i = 0; i < border.size(); ++i) {
        const int v = border[i], to = border[at(stands[i])];
        const auto around = topology.vertex_neighbours(v);
        // A wide tolerance is meant for gaps, not for edges.
        const bool joined = std::binary_search(around.begin(), around.end(), to);
        if (!joined || (mesh.positions[at(v)] - mesh.positions[at(to)]).norm() <= joined_limit)
            name[at(v)] = to;
    }
    return name;
}

int weld_border(RepairMesh& m, double tolerance, double joined_limit) {
    const MeshTopology topology(m.mesh.vertex_count(), m.mesh.triangles);
    const std::vector<int> border = border_vertices(topology);
    if (border.empty())
        return 0;
    std::vector<int> name = border_names(m.mesh, topology, border, 0, joined_limit);
    std::vector<Tri> triangles = renamed(m.mesh.triangles, name);
    if (tolerance > 0) {
        const auto open_edges = [&](const std::vector<Tri>& list) {
            return MeshTopology(m.mesh.vertex_count(), list).boundary_edges().size();
        };
        const std::vector<int> wide = border_names(m.mesh, topology, border, tolerance, joined_limit);
        std::vector<Tri> other = renamed(m.mesh.triangles, wide);
        if (wide != name && open_edges(other) < open_edges(triangles)) {
            name = wide;
            triangles = std::move(other);
        }
    }
    m.mesh.triangles = std::move(triangles);
    m.follow(name);
    int welded = 0;
    for (const int v : border)
        welded += name[at(v)] != v ? 1 : 0;
    return welded;
}

/// Back-to-back triangles t and other, in a patch of such pairs that hang together.
struct Pair {
    int first, second; ///< triangles, ascending
};

/// Marks triangles of pairs: one or both of each.
void choose_of_pairs(const std::vector<Tri>& named, const std::vector<Pair>& pairs, int vertex_count,
                     std::vector<char>& gone) {
    const std::size_t n = named.size();
    std::vector<int> pair_of(n, -1);
    for (std::size_t p = 0; p < pairs.size(); ++p)
        pair_of[at(pairs[p].first)] = pair_of[at(pairs[p].second)] = static_cast<int>(p);
    std::vector<int> parent(pairs.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](int i) {
        while (parent[at(i)] != i)
            i = parent[at(i)] = parent[at(parent[at(i)])];
        return i;
    };
    const MeshTopology topology(vertex_count, named);
    for (int pass = 0; pass < 2; ++pass) {
        std::vector<int> balance(pairs.size(), 0); // odd sides less even sides, at the root
        for (int e = 0; e < static_cast<int>(topology.edges().size()); ++e) {
            int first = -1, single = 0;
            for (const int h : topology.edge_half_edges(e)) {
                const int p = pair_of[at(h / 3)];
                if (p < 0) {
                    single += gone[at(h / 3)] ? 0 : 1;
                    continue;
                }
                const int a = root(p);
                if (first >= 0 && a != first)
                    parent[at(std::max(a, first))] = std::min(a, first);
                first = root(p);
            }
            if (first >= 0 && single > 0)
                balance[at(first)] += single % 2 == 1 ? 1 : -1;
        }
        if (pass == 0)
            continue; // the roots are known now
        for (const Pair& pair : pairs) {
            const int patch = root(pair_of[at(pair.first)]);
            gone[at(pair.second)] = 1;
            if (balance[at(patch)] < 0)
                gone[at(pair.first)] = 1;
        }
    }
}

void drop_doubles(RepairMesh& m, double tolerance, WeldCounts& counts) {
    struct Entry {
        Tri key; ///< ascending
        bool odd;
        int triangle;
        bool operator<(const Entry& o) const {
            return std::tie(key, odd, triangle) < std::tie(o.key, o.odd, o.triangle);
        }
    };
    const std::vector<Tri> named = renamed(m.mesh.triangles, near_vertices(m.mesh.positions, tolerance));
    std::vector<Entry> entries;
    entries.reserve(named.size());
    for (std::size_t i = 0; i < named.size(); ++i) {
        const Tri& t = named[i];
        if (has_repeated_index(t))
            continue;
        Tri key = t;
        std::sort(key.begin(), key.end());
        const bool odd = (t[0] > t[1]) != ((t[1] > t[2]) != (t[0] > t[2]));
        entries.push_back({key, odd, static_cast<int>(i)});
    }
    std::sort(entries.begin(), entries.end());
    std::vector<char> gone(named.size(), 0);
    std::vector<Pair> pairs;
    int doubled = 0;
    for (std::size_t i = 0; i < entries.size();) {
        std::array<int, 2> kept{-1, -1}; // by orientation
        std::size_t j = i;
        for (; j < entries.size() && entries[j].key == entries[i].key; ++j) {
            int& first = kept[entries[j].odd ? 1 : 0];
            if (first < 0) {
                first = entries[j].triangle;
            } else {
                gone[at(entries[j].triangle)] = 1;
                ++doubled;
            }
        }
        if (kept[0] >= 0 && kept[1] >= 0)
            pairs.push_back({std::min(kept[0], kept[1]), std::max(kept[0], kept[1])});
        i = j;
    }
    if (!pairs.empty())
        choose_of_pairs(named, pairs, m.mesh.vertex_count(), gone);
    const auto before = m.mesh.triangles.size();
    drop_triangles(m.mesh.triangles, gone);
    counts.doubled += doubled;
    counts.back_to_back += static_cast<int>(before - m.mesh.triangles.size()) - doubled;
}

} // namespace

WeldCounts weld_and_drop_doubles(RepairMesh& m, double tolerance) {
    WeldCounts counts;
    const double joined_limit = 1e-3 * mean_edge_length(m.mesh);
    for (int round = 0; round < 8; ++round) {
        const auto triangles = m.mesh.triangles.size();
        const int welded = counts.welded;
        counts.repeated += static_cast<int>(std::erase_if(m.mesh.triangles, has_repeated_index));
        counts.welded += weld_border(m, tolerance, joined_limit);
        counts.repeated += static_cast<int>(std::erase_if(m.mesh.triangles, has_repeated_index));
        drop_doubles(m, std::min(tolerance, joined_limit), counts);
        if (m.mesh.triangles.size() == triangles && counts.welded == welded)
            break;
    }
    return counts;
}

} // namespace fascicle::detail
