#pragma once
// Broken meshes whose repaired form is known, and what a repaired mesh must be.

#include "fascicle/geometry/repair/repair.hpp"
#include "fascicle/geometry/volume.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>
#include <random>

namespace fascicle::test {

/// The lowest common ground of every good result: closed, manifold in edges and vertices, consistent, outward, and honest about it.
inline void check_good(const RepairResult& r) {
    INFO(r.reason);
    CHECK(r.good());
    const MeshReport report = check_mesh(r.mesh);
    CHECK(report.closed());
    CHECK(report.triangles == r.mesh.triangle_count()); // none to be dropped
    CHECK(report.boundary_edges == 0);
    CHECK(report.nonmanifold_edges == 0);
    CHECK(report.nonmanifold_vertices == 0);
    CHECK(report.inconsistent_triangles == 0);
    CHECK(report.inverted_components == 0);
    CHECK(report.unused_vertices == 0);
    CHECK(report.duplicate_vertices == 0);
    CHECK(signed_volume(r.mesh.positions, r.mesh.triangles) > 0);
    CHECK(r.origins.size() == r.mesh.positions.size());
    for (const int v : r.new_of_old)
        CHECK((v >= -1 && v < r.mesh.vertex_count()));
}

inline double volume(const TriMesh& mesh) {
    return signed_volume(mesh.positions, mesh.triangles);
}

/// Every triangle with vertices of its own.
inline TriMesh soup(const TriMesh& mesh) {
    TriMesh out;
    for (const Tri& t : mesh.triangles) {
        const int n = out.vertex_count();
        for (const int v : t)
            out.positions.push_back(mesh.positions[static_cast<std::size_t>(v)]);
        out.triangles.push_back({n, n + 1, n + 2});
    }
    return out;
}

inline TriMesh shaken(TriMesh mesh, double amount, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> shift(-amount, amount);
    for (Vec3& p : mesh.positions)
        for (int k = 0; k < 3; ++k)
            p[k] += shift(random);
    return mesh;
}

/// A band of 2 n triangles about z with a number of half twists.
inline TriMesh band(int n, int half_twists) {
    TriMesh mesh;
    const double pi = 3.14159265358979323846;
    for (int i = 0; i < n; ++i) {
        const double u = 2 * pi * i / n, twist = half_twists * u / 2;
        for (const double w : {-0.3, 0.3}) {
            const double r = 1 + w * std::cos(twist);
            mesh.positions.emplace_back(r * std::cos(u), r * std::sin(u), w * std::sin(twist));
        }
    }
    for (int i = 0; i < n; ++i) {
        const bool crossed = i + 1 == n && half_twists % 2 == 1;
        const int a = 2 * i, b = a + 1, c = 2 * ((i + 1) % n) + (crossed ? 1 : 0),
                  d = 2 * ((i + 1) % n) + (crossed ? 0 : 1);
        mesh.triangles.push_back({a, c, b});
        mesh.triangles.push_back({b, c, d});
    }
    return mesh;
}

} // namespace fascicle::test
