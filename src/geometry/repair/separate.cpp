#include "fascicle/geometry/mesh_topology.hpp"
#include "fascicle/geometry/vertex_normals.hpp"
#include "geometry/repair/steps.hpp"

#include <algorithm>

namespace fascicle::detail {

namespace {

/// The way into the surface's own side: where its neighbours lie, seen along the normal (a ridge goes in, a valley out, both away
/// from the sheet that it touches); flat ones go in.
Vec3 way_off(const TriMesh& mesh, const MeshTopology& topology, const Points& normals, int v, double length) {
    Vec3 mean = Vec3::Zero();
    const auto around = topology.vertex_neighbours(v);
    for (const int u : around)
        mean += mesh.positions[at(u)] - mesh.positions[at(v)];
    const Vec3& n = normals[at(v)];
    if (n.squaredNorm() == 0)
        return mean.squaredNorm() > 0 ? Vec3(mean.normalized()) : Vec3(Vec3::Zero());
    const double height = mean.dot(n) / static_cast<double>(std::max<std::size_t>(around.size(), 1));
    return height > 1e-6 * length ? n : Vec3(-n);
}

} // namespace

int separate_sheets(RepairMesh& m, double tolerance) {
    const std::vector<int> stands = near_vertices(m.mesh.positions, tolerance);
    std::vector<int> members(stands.size(), 0);
    for (const int s : stands)
        ++members[at(s)];
    if (std::all_of(members.begin(), members.end(), [](int n) { return n <= 1; }))
        return 0;
    const MeshTopology topology(m.mesh.vertex_count(), m.mesh.triangles);
    const Points normals = vertex_normals(m.mesh.positions, m.mesh.triangles);
    Points moved = m.mesh.positions;
    int count = 0;
    for (int v = 0; v < m.mesh.vertex_count(); ++v) {
        const auto around = topology.vertex_neighbours(v);
        if (members[at(stands[at(v)])] < 2 || around.empty())
            continue;
        double length = 0;
        for (const int u : around)
            length += (m.mesh.positions[at(u)] - m.mesh.positions[at(v)]).norm();
        length /= static_cast<double>(around.size());
        // A thousandth of the edges, and more than numbers of 24 bits (STL) round away.
        const double step = std::max(1e-3 * length, 4e-7 * m.mesh.positions[at(v)].cwiseAbs().maxCoeff());
        moved[at(v)] += step * way_off(m.mesh, topology, normals, v, length);
        ++count;
    }
    m.mesh.positions = std::move(moved);
    return count;
}

} // namespace fascicle::detail
