#pragma once
// Surfaces to paint on, with closed forms.

#include "fascicle/geometry/surface_graph.hpp"
#include "support/shapes.hpp"

#include <random>

namespace fascicle::test {

inline MeshPtr shared(TriMesh mesh) {
    return std::make_shared<const TriMesh>(std::move(mesh));
}

/// The n x n sheet with its inner vertices moved within the plane by up to `amount` of a quad, diagonals at random.
inline TriMesh rough_sheet(int n, double amount, unsigned seed) {
    std::mt19937 random(seed);
    TriMesh mesh = sheet(n, n);
    std::uniform_real_distribution<double> shift(-amount, amount);
    for (Vec3& p : mesh.positions)
        if (p.x() > 0 && p.y() > 0 && p.x() < n && p.y() < n) {
            const double dx = shift(random), dy = shift(random);
            p += Vec3(dx, dy, 0);
        }
    for (std::size_t t = 0; t < mesh.triangles.size(); t += 2)
        if ((random() & 1u) != 0) {
            const int a = mesh.triangles[t][0], b = mesh.triangles[t][1], c = mesh.triangles[t][2],
                      d = mesh.triangles[t + 1][2];
            mesh.triangles[t] = {a, b, d};
            mesh.triangles[t + 1] = {b, c, d};
        }
    return mesh;
}

/// The point of the surface nearest to p.
inline SurfacePoint foot(const SurfaceGraph& graph, const Vec3& p) {
    return graph.tree().closest(p);
}

/// A region of vertices for which accept(position) holds.
template <typename Region, typename Accept>
Region region_where(const SurfaceGraph& graph, const Accept& accept) {
    Region region(graph.vertex_count());
    for (int v = 0; v < graph.vertex_count(); ++v)
        if (accept(graph.position(v)))
            region.insert(v);
    return region;
}

} // namespace fascicle::test
