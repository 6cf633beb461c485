#pragma once
// The vertices of a surface in small balls, to ask about many at once.

#include "fascicle/geometry/tri_mesh.hpp"

namespace fascicle {

struct VertexCluster {
    Vec3 centre = Vec3::Zero();
    double radius = 0;      ///< every vertex of the cluster is within
    int begin = 0, end = 0; ///< in VertexClusters::points
};

struct VertexClusters {
    std::vector<VertexCluster> clusters;
    Points points; ///< vertices that triangles use, cluster by cluster
};

/// Halved along the longest side of their box until no more than `most` are left in one. Neighbours in the list are close.
VertexClusters cluster_vertices(const TriMesh& mesh, int most);

} // namespace fascicle
