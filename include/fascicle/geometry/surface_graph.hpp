#pragma once
// What every operation on a surface's vertices needs of it, built once for each bone.

#include "fascicle/geometry/bvh.hpp"
#include "fascicle/geometry/mesh_topology.hpp"
#include "fascicle/geometry/tri_mesh.hpp"

#include <span>

namespace fascicle {

/// Edges of a triangle: edge k joins its corners k and k + 1; all -1 for a triangle with a repeated index.
using TriEdges = std::array<int, 3>;

/// Any triangle list with finite points and indices in range: open, non-manifold, with triangles without area.
/// Vertices that no triangle uses have no neighbours and no area. Parts that touch only through coincident but
/// separate vertices are not connected.
class SurfaceGraph {
public:
    /// mesh: not null; kept.
    explicit SurfaceGraph(MeshPtr mesh);

    const TriMesh& mesh() const { return *mesh_; }
    const MeshPtr& mesh_ptr() const { return mesh_; }
    const MeshTopology& topology() const { return topology_; }
    /// Nearest surface points, and rays.
    const TriangleBvh& tree() const { return tree_; }

    int vertex_count() const { return mesh_->vertex_count(); }
    const Vec3& position(int v) const { return mesh_->positions[static_cast<std::size_t>(v)]; }
    const Tri& triangle(int t) const { return mesh_->triangles[static_cast<std::size_t>(t)]; }

    /// Scene units.
    double edge_length(int e) const { return edge_lengths_[static_cast<std::size_t>(e)]; }
    double mean_edge_length() const { return mean_edge_length_; }
    /// Edges of a vertex, in the order of topology().vertex_neighbours(v).
    std::span<const int> vertex_edges(int v) const;
    const TriEdges& triangle_edges(int t) const { return triangle_edges_[static_cast<std::size_t>(t)]; }
    /// The edge of two vertices, or -1.
    int edge_between(int a, int b) const;

    /// Unit normal, zero for a triangle without area.
    const Vec3& normal(int t) const { return normals_[static_cast<std::size_t>(t)]; }
    double triangle_area(int t) const { return triangle_areas_[static_cast<std::size_t>(t)]; }
    /// One third of the areas of its triangles: the vertices' areas sum to that of the surface. Scene units squared.
    double vertex_area(int v) const { return vertex_areas_[static_cast<std::size_t>(v)]; }
    double area() const { return area_; }

    std::size_t bytes() const;

private:
    MeshPtr mesh_;
    MeshTopology topology_;
    TriangleBvh tree_;
    std::vector<double> edge_lengths_, triangle_areas_, vertex_areas_;
    std::vector<int> edge_starts_, vertex_edges_;
    std::vector<TriEdges> triangle_edges_;
    Points normals_;
    double mean_edge_length_ = 0, area_ = 0;
};

/// Corner of the point's triangle that it is nearest to.
int nearest_corner(const SurfaceGraph& graph, const SurfacePoint& at);

} // namespace fascicle
