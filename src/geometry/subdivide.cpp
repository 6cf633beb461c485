#include "fascicle/geometry/subdivide.hpp"

#include "fascicle/base/assert.hpp"

namespace fascicle {

namespace {

/// New vertex on the side from corner k to k + 1 of every triangle, -1 where there is none.
std::vector<std::array<int, 3>> side_vertices(const TriMesh& mesh, const MeshTopology& topology) {
    std::vector<std::array<int, 3>> sides(mesh.triangles.size(), {-1, -1, -1});
    for (std::size_t e = 0; e < topology.edges().size(); ++e)
        for (const int half : topology.edge_half_edges(static_cast<int>(e)))
            sides[static_cast<std::size_t>(half / 3)][static_cast<std::size_t>(half % 3)] =
                mesh.vertex_count() + static_cast<int>(e);
    return sides;
}

} // namespace

Subdivision subdivide(const TriMesh& mesh, const MeshTopology& topology) {
    FASCICLE_ASSERT(topology.vertex_count() == mesh.vertex_count());
    Subdivision result;
    result.parents = topology.edges();
    Points& points = result.mesh.positions;
    points.reserve(mesh.positions.size() + result.parents.size());
    points = mesh.positions;
    for (const Edge& edge : result.parents)
        points.push_back(0.5 * (mesh.positions[static_cast<std::size_t>(edge.a)] +
                                mesh.positions[static_cast<std::size_t>(edge.b)]));
    const auto sides = side_vertices(mesh, topology);
    result.mesh.triangles.reserve(4 * mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto [a, b, c] = mesh.triangles[t];
        const auto [ab, bc, ca] = sides[t];
        if (has_repeated_index(mesh.triangles[t]))
            continue;
        for (const Tri& part : {Tri{a, ab, ca}, Tri{ab, b, bc}, Tri{ca, bc, c}, Tri{ab, bc, ca}})
            result.mesh.triangles.push_back(part);
    }
    return result;
}

Subdivision subdivide(const TriMesh& mesh) {
    return subdivide(mesh, MeshTopology(mesh.vertex_count(), mesh.triangles));
}

std::vector<int> subdivided_labels(const Subdivision& subdivision, const std::vector<int>& labels) {
    FASCICLE_ASSERT(labels.size() + subdivision.parents.size() == subdivision.mesh.positions.size());
    std::vector<int> result = labels;
    for (const Edge& edge : subdivision.parents) {
        const int a = labels[static_cast<std::size_t>(edge.a)], b = labels[static_cast<std::size_t>(edge.b)];
        result.push_back(a == b ? a : -1);
    }
    return result;
}

std::vector<double> subdivided_values(const Subdivision& subdivision, const std::vector<double>& values,
                                      std::size_t width) {
    FASCICLE_ASSERT(values.size() + width * subdivision.parents.size() ==
                    width * subdivision.mesh.positions.size());
    std::vector<double> result = values;
    result.reserve(width * subdivision.mesh.positions.size());
    for (const Edge& edge : subdivision.parents)
        for (std::size_t k = 0; k < width; ++k)
            result.push_back(0.5 * (values[static_cast<std::size_t>(edge.a) * width + k] +
                                    values[static_cast<std::size_t>(edge.b) * width + k]));
    return result;
}

} // namespace fascicle
