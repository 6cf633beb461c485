#include "fascicle/geometry/fill_holes.hpp"
#include "fascicle/geometry/mesh_topology.hpp"
#include "geometry/repair/steps.hpp"

#include <Eigen/Geometry>

namespace fascicle::detail {

namespace {

/// Half the length of the sum of p_i x p_(i+1): the area of a flat ring, and of the flat part of any other.
double ring_area(const TriMesh& mesh, const std::vector<int>& ring) {
    Vec3 sum = Vec3::Zero();
    const Vec3& origin = mesh.positions[at(ring[0])];
    for (std::size_t i = 1; i + 1 < ring.size(); ++i)
        sum += (mesh.positions[at(ring[i])] - origin).cross(mesh.positions[at(ring[i + 1])] - origin);
    return 0.5 * sum.norm();
}

std::vector<double> part_areas(const TriMesh& mesh, const MeshTopology& topology) {
    std::vector<double> areas(at(topology.component_count()), 0);
    for (const Tri& t : mesh.triangles) {
        const Vec3& a = mesh.positions[at(t[0])];
        areas[at(topology.vertex_component(t[0]))] +=
            (mesh.positions[at(t[1])] - a).cross(mesh.positions[at(t[2])] - a).norm() / 2;
    }
    return areas;
}

} // namespace

FillCounts fill_and_fair(RepairMesh& m, int max_edges, double share) {
    FillCounts counts;
    const int first = m.mesh.triangle_count();
    const MeshTopology topology(m.mesh.vertex_count(), m.mesh.triangles);
    if (topology.boundary_edges().empty())
        return counts;
    const std::vector<double> areas = part_areas(m.mesh, topology);
    HoleFilling filling = fill_holes(m.mesh, max_edges, [&](const std::vector<int>& ring) {
        const bool fits = ring_area(m.mesh, ring) <= share * areas[at(topology.vertex_component(ring[0]))];
        counts.too_large += fits ? 0 : 1;
        return fits;
    });
    counts.holes = filling.filled + filling.left;
    counts.filled = filling.filled;
    counts.area = filling.added_area;
    m.mesh = std::move(filling.mesh);
    if (counts.filled > 0 && closed_and_paired(m.mesh))
        counts.vertices = fair_patches(m, first);
    counts.triangles = m.mesh.triangle_count() - first;
    return counts;
}

} // namespace fascicle::detail
