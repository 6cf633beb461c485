#include "fascicle/geometry/mesh_check.hpp"

#include "geometry/mesh_orient.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>

namespace fascicle {
namespace {

std::size_t z(int i) {
    return static_cast<std::size_t>(i);
}

void check_numbers(const TriMesh& mesh, MeshReport& report) {
    for (int v = 0; v < mesh.vertex_count(); ++v)
        if (!mesh.positions[z(v)].allFinite() && report.non_finite_points++ == 0)
            report.first_non_finite_point = v;
    for (int t = 0; t < mesh.triangle_count(); ++t)
        for (const int v : mesh.triangles[z(t)])
            if (v < 0 || v >= mesh.vertex_count()) {
                if (report.bad_triangles++ == 0)
                    report.first_bad_triangle = t;
                break;
            }
}

/// The same cyclic order, beginning with the lowest vertex.
Tri lowest_first(Tri t) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
}

/// visit(triangle) for every triangle whose key is that of one before it. key(t) begins with t's lowest vertex.
template <typename Key, typename Visit>
void each_double(const std::vector<Tri>& triangles, const Key& key, const Visit& visit) {
    struct Entry {
        int second, third; // vertices of the key
        int triangle;
    };
    int vertex_count = 0;
    for (const Tri& t : triangles)
        vertex_count = std::max({vertex_count, t[0] + 1, t[1] + 1, t[2] + 1});
    // Into buckets by the lowest vertex, a few in each.
    std::vector<int> starts(z(vertex_count) + 1, 0);
    for (const Tri& t : triangles)
        ++starts[z(std::min({t[0], t[1], t[2]})) + 1];
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    std::vector<Entry> entries(triangles.size());
    std::vector<int> next(starts.begin(), starts.end() - 1);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const Tri k = key(triangles[t]);
        entries[z(next[z(k[0])]++)] = {k[1], k[2], static_cast<int>(t)};
    }
    for (std::size_t v = 0; v < z(vertex_count); ++v) {
        const auto begin = entries.begin() + starts[v], end = entries.begin() + starts[v + 1];
        if (end - begin < 2)
            continue;
        std::sort(begin, end, [](const Entry& x, const Entry& y) {
            return std::tie(x.second, x.third, x.triangle) < std::tie(y.second, y.third, y.triangle);
        });
        for (auto it = begin + 1; it != end; ++it)
            if (it->second == (it - 1)->second && it->third == (it - 1)->third)
                visit(it->triangle);
    }
}

/// Drops triangles with repeated indices and same-oriented duplicates, keeping the order of the rest.
void drop_surplus(std::vector<Tri>& triangles, MeshReport& report) {
    const std::size_t before = triangles.size();
    std::erase_if(triangles, has_repeated_index);
    report.degenerate_triangles = static_cast<int>(before - triangles.size());

    std::vector<char> surplus(triangles.size(), 0);
    each_double(triangles, lowest_first, [&](int triangle) {
        surplus[z(triangle)] = 1;
        ++report.duplicate_triangles;
    });
    std::size_t kept = 0;
    for (std::size_t t = 0; t < triangles.size(); ++t)
        if (!surplus[t])
            triangles[kept++] = triangles[t];
    triangles.resize(kept);
}

int count_opposite_duplicates(const std::vector<Tri>& triangles) {
    int count = 0;
    const auto ascending = [](Tri t) {
        std::sort(t.begin(), t.end());
        return t;
    };
    each_double(triangles, ascending, [&](int) { ++count; });
    return count;
}

int count_zero_areas(const TriMesh& mesh) {
    int count = 0;
    for (const Tri& t : mesh.triangles) {
        const Vec3 a = mesh.positions[z(t[1])] - mesh.positions[z(t[0])];
        const Vec3 b = mesh.positions[z(t[2])] - mesh.positions[z(t[0])];
        const double l2 = std::max({a.squaredNorm(), b.squaredNorm(), (b - a).squaredNorm()});
        count += a.cross(b).squaredNorm() <= 1e-12 * l2 * l2 ? 1 : 0;
    }
    return count;
}

void check_edges(const std::vector<Tri>& triangles, const MeshTopology& topology, MeshReport& report) {
    report.boundary_edges = static_cast<int>(topology.boundary_edges().size());
    if (report.boundary_edges > 0)
        report.first_boundary_edge = topology.edges()[z(topology.boundary_edges()[0])];
    report.nonmanifold_edges = static_cast<int>(topology.nonmanifold_edges().size());
    if (report.nonmanifold_edges > 0)
        report.first_nonmanifold_edge = topology.edges()[z(topology.nonmanifold_edges()[0])];
    for (int e = 0; e < static_cast<int>(topology.edges().size()); ++e) {
        int net = 0;
        for (const int h : topology.edge_half_edges(e))
            net += triangles[z(h / 3)][z(h % 3)] == topology.edges()[z(e)].a ? 1 : -1;
        if (net != 0 && report.unbalanced_edges++ == 0)
            report.first_unbalanced_edge = topology.edges()[z(e)];
    }
}

/// Boundary edges that hang together through vertices make one hole.
int count_holes(const MeshTopology& topology) {
    std::vector<int> parent(z(topology.vertex_count()));
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](int v) {
        while (parent[z(v)] != v)
            v = parent[z(v)] = parent[z(parent[z(v)])];
        return v;
    };
    int holes = 0;
    std::vector<char> touched(parent.size(), 0);
    for (const int e : topology.boundary_edges()) {
        const Edge edge = topology.edges()[z(e)];
        for (const int v : {edge.a, edge.b}) {
            holes += touched[z(v)] ? 0 : 1;
            touched[z(v)] = 1;
        }
        const int a = root(edge.a), b = root(edge.b);
        if (a != b) {
            parent[z(std::max(a, b))] = std::min(a, b);
            --holes;
        }
    }
    return holes;
}

/// By vertex: into how many fans that share no edge at it its triangles fall.
std::vector<int> fan_counts(const std::vector<Tri>& triangles, const MeshTopology& topology) {
    std::vector<int> parent(3 * triangles.size()); // by corner
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](int i) {
        while (parent[z(i)] != i)
            i = parent[z(i)] = parent[z(parent[z(i)])];
        return i;
    };
    std::vector<int> fans(z(topology.vertex_count()));
    for (int v = 0; v < topology.vertex_count(); ++v)
        fans[z(v)] = static_cast<int>(topology.vertex_triangles(v).size());
    for (int e = 0; e < static_cast<int>(topology.edges().size()); ++e) {
        const auto row = topology.edge_half_edges(e);
        for (std::size_t i = 1; i < row.size(); ++i)
            for (const int v : {topology.edges()[z(e)].a, topology.edges()[z(e)].b}) {
                const auto corner = [&](int half_edge) {
                    const Tri& t = triangles[z(half_edge / 3)];
                    return root(half_edge - half_edge % 3 + (t[0] == v ? 0 : t[1] == v ? 1 : 2));
                };
                const int x = corner(row[i - 1]), y = corner(row[i]);
                if (x != y) {
                    parent[z(std::max(x, y))] = std::min(x, y);
                    --fans[z(v)];
                }
            }
    }
    return fans;
}

void check_vertices(const TriMesh& mesh, const MeshTopology& topology, MeshReport& report) {
    struct Used {
        double x;
        int vertex;
    };
    std::vector<Used> used;
    used.reserve(mesh.positions.size());
    const std::vector<int> fans = fan_counts(mesh.triangles, topology);
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        if (fans[z(v)] == 0) {
            ++report.unused_vertices;
            continue;
        }
        used.push_back({mesh.positions[z(v)].x(), v});
        if (fans[z(v)] > 1 && report.nonmanifold_vertices++ == 0)
            report.first_nonmanifold_vertex = v;
    }
    // By x alone first, whose values lie side by side; y and z decide among the few that are equal.
    std::sort(used.begin(), used.end(), [](const Used& a, const Used& b) { return a.x < b.x; });
    const auto rest = [&](const Used& u) {
        const Vec3& p = mesh.positions[z(u.vertex)];
        return std::pair{p.y(), p.z()};
    };
    for (auto begin = used.begin(); begin != used.end();) {
        const auto end = std::find_if(begin, used.end(), [&](const Used& u) { return u.x != begin->x; });
        std::sort(begin, end, [&](const Used& a, const Used& b) { return rest(a) < rest(b); });
        for (auto it = begin; it != end; ++it)
            report.duplicate_vertices += it != begin && rest(*it) == rest(*(it - 1)) ? 1 : 0;
        begin = end;
    }
}

} // namespace

MendedMesh mend(TriMesh mesh) {
    MendedMesh result{std::move(mesh), {}};
    MeshReport& report = result.report;
    report.vertices = result.mesh.vertex_count();
    report.triangles = result.mesh.triangle_count();
    check_numbers(result.mesh, report);
    if (!report.usable())
        return result;

    drop_surplus(result.mesh.triangles, report);
    detail::OrientationChanges changes = detail::orient(result.mesh);
    report.inconsistent_triangles = changes.inconsistent_triangles;
    report.non_orientable_patches = changes.non_orientable_patches;
    report.inverted_components = changes.inverted_components;
    report.cavities = changes.cavities;

    // Turned triangles walk their edges the other way.
    const MeshTopology topology = changes.turned
                                      ? MeshTopology(result.mesh.vertex_count(), result.mesh.triangles)
                                      : std::move(changes.topology);
    report.triangles = result.mesh.triangle_count();
    report.components = topology.component_count();
    report.zero_area_triangles = count_zero_areas(result.mesh);
    report.opposite_duplicates = count_opposite_duplicates(result.mesh.triangles);
    report.holes = count_holes(topology);
    check_edges(result.mesh.triangles, topology, report);
    check_vertices(result.mesh, topology, report);
    return result;
}

MeshReport check_mesh(const TriMesh& mesh) {
    return mend(mesh).report;
}

} // namespace fascicle
