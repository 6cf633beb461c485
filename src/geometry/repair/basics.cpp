// What the steps of repair() share.
#include "fascicle/geometry/mesh_topology.hpp"
#include "geometry/mesh_orient.hpp"
#include "geometry/repair/steps.hpp"

#include <algorithm>

namespace fascicle::detail {

namespace {

/// Beyond this the fourth power of a length is no longer a number.
constexpr double largest_coordinate = 1e50;

} // namespace

int drop_unusable(TriMesh& mesh) {
    std::vector<char> bad(mesh.positions.size(), 0);
    for (std::size_t v = 0; v < bad.size(); ++v)
        bad[v] =
            !mesh.positions[v].allFinite() || mesh.positions[v].cwiseAbs().maxCoeff() > largest_coordinate;
    return static_cast<int>(std::erase_if(mesh.triangles, [&](const Tri& t) {
        return std::any_of(t.begin(), t.end(),
                           [&](int v) { return v < 0 || v >= mesh.vertex_count() || bad[at(v)] != 0; });
    }));
}

int drop_unused_vertices(RepairMesh& m) {
    std::vector<int> number(m.mesh.positions.size(), -1);
    for (const Tri& t : m.mesh.triangles)
        for (const int v : t)
            number[at(v)] = 0;
    int count = 0;
    for (std::size_t v = 0; v < number.size(); ++v) {
        if (number[v] < 0)
            continue;
        m.mesh.positions[at(count)] = m.mesh.positions[v];
        m.origins[at(count)] = m.origins[v];
        number[v] = count++;
    }
    const int dropped = m.mesh.vertex_count() - count;
    m.mesh.positions.resize(at(count));
    m.origins.resize(at(count));
    for (Tri& t : m.mesh.triangles)
        for (int& v : t)
            v = number[at(v)];
    m.follow(number);
    return dropped;
}

void drop_triangles(std::vector<Tri>& triangles, const std::vector<char>& gone) {
    std::size_t kept = 0;
    for (std::size_t t = 0; t < triangles.size(); ++t)
        if (!gone[t])
            triangles[kept++] = triangles[t];
    triangles.resize(kept);
}

double mean_edge_length(const TriMesh& mesh) {
    double sum = 0;
    std::size_t count = 0;
    for (const Tri& t : mesh.triangles) {
        if (has_repeated_index(t))
            continue;
        for (std::size_t k = 0; k < 3; ++k)
            sum += (mesh.positions[at(t[k])] - mesh.positions[at(t[(k + 1) % 3])]).norm();
        count += 3;
    }
    return count > 0 ? sum / static_cast<double>(count) : 0;
}

bool closed_and_paired(const TriMesh& mesh) {
    if (std::any_of(mesh.triangles.begin(), mesh.triangles.end(), has_repeated_index))
        return false;
    const MeshTopology topology(mesh.vertex_count(), mesh.triangles);
    return !mesh.triangles.empty() && topology.boundary_edges().empty() &&
           topology.nonmanifold_edges().empty() && topology.inconsistent_edges().empty();
}

OrientCounts orient_outwards(RepairMesh& m) {
    const OrientationChanges changes = orient(m.mesh);
    return {changes.inconsistent_triangles, changes.inverted_components, changes.cavities,
            changes.non_orientable_patches};
}

} // namespace fascicle::detail
