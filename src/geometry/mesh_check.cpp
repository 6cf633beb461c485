#include "fascicle/geometry/mesh_check.hpp"

#include "geometry/mesh_orient.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

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

/// Drops triangles with repeated indices and same-oriented duplicates, keeping the order of the rest.
void drop_surplus(std::vector<Tri>& triangles, MeshReport& report) {
    const std::size_t before = triangles.size();
    std::erase_if(triangles, has_repeated_index);
    report.degenerate_triangles = static_cast<int>(before - triangles.size());

    struct Key {
        std::array<int, 3> vertices; // lowest first, cyclic order kept
        int triangle;
    };
    std::vector<Key> keys(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        keys[t] = {triangles[t], static_cast<int>(t)};
        std::rotate(keys[t].vertices.begin(),
                    std::min_element(keys[t].vertices.begin(), keys[t].vertices.end()),
                    keys[t].vertices.end());
    }
    std::sort(keys.begin(), keys.end(), [](const Key& x, const Key& y) {
        return x.vertices != y.vertices ? x.vertices < y.vertices : x.triangle < y.triangle;
    });
    std::vector<char> surplus(triangles.size(), 0);
    for (std::size_t i = 1; i < keys.size(); ++i)
        if (keys[i].vertices == keys[i - 1].vertices) {
            surplus[z(keys[i].triangle)] = 1;
            ++report.duplicate_triangles;
        }
    std::size_t kept = 0;
    for (std::size_t t = 0; t < triangles.size(); ++t)
        if (!surplus[t])
            triangles[kept++] = triangles[t];
    triangles.resize(kept);
}

int count_opposite_duplicates(const std::vector<Tri>& triangles) {
    std::vector<Tri> sorted(triangles);
    for (Tri& t : sorted)
        std::sort(t.begin(), t.end());
    std::sort(sorted.begin(), sorted.end());
    int count = 0;
    for (std::size_t i = 1; i < sorted.size(); ++i)
        count += sorted[i] == sorted[i - 1] ? 1 : 0;
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

/// Whether the triangles at a vertex fall into several fans that share no edge at it.
bool several_fans(const std::vector<Tri>& triangles, std::span<const int> around, int vertex) {
    struct Spoke {
        int to;
        int triangle;
    };
    std::vector<Spoke> spokes;
    for (std::size_t i = 0; i < around.size(); ++i)
        for (const int v : triangles[z(around[i])])
            if (v != vertex)
                spokes.push_back({v, static_cast<int>(i)});
    std::sort(spokes.begin(), spokes.end(), [](const Spoke& x, const Spoke& y) { return x.to < y.to; });
    std::vector<int> parent(around.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](int i) {
        while (parent[z(i)] != i)
            i = parent[z(i)] = parent[z(parent[z(i)])];
        return i;
    };
    std::size_t fans = around.size();
    for (std::size_t i = 1; i < spokes.size(); ++i)
        if (spokes[i].to == spokes[i - 1].to) {
            const int a = root(spokes[i].triangle), b = root(spokes[i - 1].triangle);
            if (a != b) {
                parent[z(a)] = b;
                --fans;
            }
        }
    return fans > 1;
}

void check_vertices(const TriMesh& mesh, const MeshTopology& topology, MeshReport& report) {
    std::vector<int> used;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const auto around = topology.vertex_triangles(v);
        if (around.empty()) {
            ++report.unused_vertices;
            continue;
        }
        used.push_back(v);
        if (several_fans(mesh.triangles, around, v) && report.nonmanifold_vertices++ == 0)
            report.first_nonmanifold_vertex = v;
    }
    const auto key = [&](int v) {
        const Vec3& p = mesh.positions[z(v)];
        return std::array<double, 3>{p.x(), p.y(), p.z()};
    };
    std::sort(used.begin(), used.end(), [&](int x, int y) { return key(x) < key(y); });
    for (std::size_t i = 1; i < used.size(); ++i)
        report.duplicate_vertices += key(used[i]) == key(used[i - 1]) ? 1 : 0;
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
    const detail::OrientationChanges changes = detail::orient(result.mesh);
    report.inconsistent_triangles = changes.inconsistent_triangles;
    report.non_orientable_patches = changes.non_orientable_patches;
    report.inverted_components = changes.inverted_components;
    report.cavities = changes.cavities;

    const MeshTopology topology(result.mesh.vertex_count(), result.mesh.triangles);
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
