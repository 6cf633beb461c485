#include "fascicle/geometry/surface_graph.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/base/bytes_of.hpp"

#include <algorithm>

namespace fascicle {
namespace {

std::size_t z(int i) {
    return static_cast<std::size_t>(i);
}

const TriMesh& checked(const MeshPtr& mesh) {
    FASCICLE_ASSERT(mesh != nullptr);
    return *mesh;
}

} // namespace

SurfaceGraph::SurfaceGraph(MeshPtr mesh)
    : mesh_(std::move(mesh)), topology_(checked(mesh_).vertex_count(), mesh_->triangles), tree_(*mesh_) {
    const std::vector<Edge>& edges = topology_.edges();
    edge_lengths_.reserve(edges.size());
    double sum = 0;
    edge_starts_.assign(z(vertex_count()) + 1, 0);
    for (const Edge& e : edges) {
        edge_lengths_.push_back((position(e.a) - position(e.b)).norm());
        sum += edge_lengths_.back();
        ++edge_starts_[z(e.a) + 1];
        ++edge_starts_[z(e.b) + 1];
    }
    mean_edge_length_ = edges.empty() ? 0.0 : sum / double(edges.size());
    for (std::size_t v = 1; v < edge_starts_.size(); ++v)
        edge_starts_[v] += edge_starts_[v - 1];
    // The same two passes that fill the neighbours of MeshTopology, so the rows match.
    vertex_edges_.resize(z(edge_starts_.back()));
    std::vector<int> next(edge_starts_.begin(), edge_starts_.end() - 1);
    for (std::size_t e = 0; e < edges.size(); ++e)
        vertex_edges_[z(next[z(edges[e].b)]++)] = static_cast<int>(e);
    for (std::size_t e = 0; e < edges.size(); ++e)
        vertex_edges_[z(next[z(edges[e].a)]++)] = static_cast<int>(e);

    triangle_edges_.assign(mesh_->triangles.size(), {-1, -1, -1});
    for (std::size_t e = 0; e < edges.size(); ++e)
        for (const int half_edge : topology_.edge_half_edges(static_cast<int>(e)))
            triangle_edges_[z(half_edge / 3)][z(half_edge % 3)] = static_cast<int>(e);

    normals_.assign(mesh_->triangles.size(), Vec3::Zero());
    triangle_areas_.assign(mesh_->triangles.size(), 0.0);
    vertex_areas_.assign(mesh_->positions.size(), 0.0);
    for (std::size_t t = 0; t < normals_.size(); ++t) {
        const Tri& tri = mesh_->triangles[t];
        if (has_repeated_index(tri))
            continue;
        const Vec3 cross = (position(tri[1]) - position(tri[0])).cross(position(tri[2]) - position(tri[0]));
        const double length = cross.norm();
        triangle_areas_[t] = 0.5 * length;
        area_ += triangle_areas_[t];
        if (length > 0.0)
            normals_[t] = cross / length;
        for (const int v : tri)
            vertex_areas_[z(v)] += triangle_areas_[t] / 3.0;
    }
}

std::span<const int> SurfaceGraph::vertex_edges(int v) const {
    const auto begin = z(edge_starts_[z(v)]), end = z(edge_starts_[z(v) + 1]);
    return {vertex_edges_.data() + begin, end - begin};
}

int SurfaceGraph::edge_between(int a, int b) const {
    const auto neighbours = topology_.vertex_neighbours(a);
    const auto it = std::lower_bound(neighbours.begin(), neighbours.end(), b);
    if (it == neighbours.end() || *it != b)
        return -1;
    return vertex_edges(a)[static_cast<std::size_t>(it - neighbours.begin())];
}

std::size_t SurfaceGraph::bytes() const {
    return topology_.bytes() + tree_.bytes() +
           bytes_of(edge_lengths_, triangle_areas_, vertex_areas_, edge_starts_, vertex_edges_,
                    triangle_edges_, normals_);
}

int nearest_corner(const SurfaceGraph& graph, const SurfacePoint& at) {
    FASCICLE_ASSERT(at.triangle >= 0);
    int best = -1;
    for (const int v : graph.triangle(at.triangle))
        if (best < 0 ||
            (graph.position(v) - at.point).squaredNorm() < (graph.position(best) - at.point).squaredNorm())
            best = v;
    return best;
}

} // namespace fascicle
