#include "simulation/vertex_clusters.hpp"

#include "fascicle/geometry/bounding_box.hpp"

#include <algorithm>

namespace fascicle {

namespace {

void divide(VertexClusters& all, int begin, int end, int most) {
    const auto first = all.points.begin() + begin, last = all.points.begin() + end;
    BoundingBox box;
    std::for_each(first, last, [&](const Vec3& p) { box.add(p); });
    if (end - begin > most) {
        Eigen::Index axis = 0;
        box.size().maxCoeff(&axis);
        const int middle = begin + (end - begin) / 2;
        std::nth_element(first, all.points.begin() + middle, last,
                         [axis](const Vec3& a, const Vec3& b) { return a[axis] < b[axis]; });
        divide(all, begin, middle, most);
        divide(all, middle, end, most);
        return;
    }
    VertexCluster cluster{box.center(), 0, begin, end};
    std::for_each(first, last, [&](const Vec3& p) {
        cluster.radius = std::max(cluster.radius, (p - cluster.centre).norm());
    });
    all.clusters.push_back(cluster);
}

} // namespace

VertexClusters cluster_vertices(const TriMesh& mesh, int most) {
    VertexClusters all;
    std::vector<char> used(mesh.positions.size(), 0);
    for (const Tri& t : mesh.triangles)
        for (const int v : t)
            used[static_cast<std::size_t>(v)] = 1;
    for (std::size_t v = 0; v < used.size(); ++v)
        if (used[v] != 0)
            all.points.push_back(mesh.positions[v]);
    if (!all.points.empty())
        divide(all, 0, static_cast<int>(all.points.size()), most);
    return all;
}

} // namespace fascicle
