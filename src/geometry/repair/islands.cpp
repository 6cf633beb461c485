#include "fascicle/geometry/mesh_topology.hpp"
#include "fascicle/geometry/volume.hpp"
#include "geometry/repair/steps.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::detail {

namespace {

struct Part {
    double area = 0, volume = 0;
    int triangles = 0;
    bool open = false, hanging = false;
};

struct Parts {
    std::vector<int> of_triangle;
    std::vector<Part> parts;
};

/// Parts that hang together through vertices; volumes are those of closed parts.
Parts find_parts(const TriMesh& mesh, const std::vector<char>& hanging) {
    const MeshTopology topology(mesh.vertex_count(), mesh.triangles);
    Parts out;
    out.parts.resize(at(topology.component_count()));
    // About a point of each part, so that far ones lose no digits.
    std::vector<Vec3> centre(out.parts.size(), Vec3::Zero());
    std::vector<char> seen(out.parts.size(), 0);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Tri& tri = mesh.triangles[t];
        const int p = topology.vertex_component(tri[0]);
        out.of_triangle.push_back(p);
        Part& part = out.parts[at(p)];
        if (!seen[at(p)]) {
            seen[at(p)] = 1;
            centre[at(p)] = mesh.positions[at(tri[0])];
        }
        const Vec3 a = mesh.positions[at(tri[0])] - centre[at(p)],
                   b = mesh.positions[at(tri[1])] - centre[at(p)],
                   c = mesh.positions[at(tri[2])] - centre[at(p)];
        part.area += (b - a).cross(c - a).norm() / 2;
        part.volume += a.dot(b.cross(c)) / 6;
        ++part.triangles;
        part.hanging = part.hanging || (!hanging.empty() && hanging[t] != 0);
    }
    for (const int e : topology.boundary_edges())
        out.parts[at(topology.vertex_component(topology.edges()[at(e)].a))].open = true;
    return out;
}

/// Drops the triangles of the parts marked with 1; returns how many.
int drop_parts(RepairMesh& m, const Parts& parts, const std::vector<char>& gone) {
    std::vector<char> marks(m.mesh.triangles.size());
    for (std::size_t t = 0; t < marks.size(); ++t)
        marks[t] = gone[at(parts.of_triangle[t])];
    const auto before = m.mesh.triangles.size();
    drop_triangles(m.mesh.triangles, marks);
    return static_cast<int>(before - m.mesh.triangles.size());
}

} // namespace

IslandCounts drop_islands(RepairMesh& m, std::vector<char> hanging, double share) {
    IslandCounts counts;
    const Parts parts = find_parts(m.mesh, hanging);
    if (parts.parts.size() < 2)
        return counts;
    const auto largest = std::max_element(parts.parts.begin(), parts.parts.end(),
                                          [](const Part& a, const Part& b) { return a.area < b.area; });
    std::vector<char> gone(parts.parts.size(), 0);
    for (std::size_t p = 0; p < gone.size(); ++p) {
        const Part& part = parts.parts[p];
        if (&part == &*largest)
            continue;
        const bool sheet = part.open && part.hanging, island = part.area < share * largest->area;
        gone[p] = sheet || island;
        counts.sheets += sheet ? 1 : 0;
        counts.islands += !sheet && island ? 1 : 0;
    }
    counts.triangles = drop_parts(m, parts, gone);
    return counts;
}

IslandCounts drop_flat_parts(RepairMesh& m) {
    IslandCounts counts;
    const Parts parts = find_parts(m.mesh, {});
    std::vector<char> gone(parts.parts.size(), 0);
    for (std::size_t p = 0; p < gone.size(); ++p) {
        const Part& part = parts.parts[p];
        gone[p] = !part.open && std::abs(part.volume) <= 1e-6 * std::pow(part.area, 1.5);
        counts.flat += gone[p];
    }
    if (counts.flat > 0)
        counts.triangles = drop_parts(m, parts, gone);
    return counts;
}

} // namespace fascicle::detail
