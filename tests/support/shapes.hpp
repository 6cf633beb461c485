#pragma once
// Small meshes whose properties are known, for tests.

#include "fascicle/geometry/tri_mesh.hpp"

#include <array>
#include <cmath>
#include <map>

namespace fascicle::test {

/// Corner at the origin, edges of length a along the axes: volume a^3/6. Counter-clockwise from outside.
inline TriMesh tetrahedron(double a = 1.0) {
    return {{Vec3(0, 0, 0), Vec3(a, 0, 0), Vec3(0, a, 0), Vec3(0, 0, a)},
            {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

/// [0, x] x [0, y] x [0, z] with two triangles a side: 8 vertices (index = ix + 2 iy + 4 iz), 12 triangles.
inline TriMesh box(double x = 1.0, double y = 1.0, double z = 1.0) {
    TriMesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.positions.emplace_back(i & 1 ? x : 0.0, i & 2 ? y : 0.0, i & 4 ? z : 0.0);
    const auto quad = [&](int a, int b, int c, int d) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
    };
    quad(0, 2, 3, 1);
    quad(4, 5, 7, 6);
    quad(0, 1, 5, 4);
    quad(2, 6, 7, 3);
    quad(0, 4, 6, 2);
    quad(1, 3, 7, 5);
    return mesh;
}

/// Octahedron refined `levels` times, vertices on the sphere: 4^(levels + 1) + 2 of them, 8 * 4^levels
/// triangles.
inline TriMesh sphere(double radius = 1.0, int levels = 3, const Vec3& centre = Vec3::Zero()) {
    TriMesh mesh{
        {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0), Vec3(0, 0, 1), Vec3(0, 0, -1)},
        {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
    for (int level = 0; level < levels; ++level) {
        std::map<std::array<int, 2>, int> middles;
        const auto middle = [&](int a, int b) {
            const std::array<int, 2> key{std::min(a, b), std::max(a, b)};
            const auto [it, fresh] = middles.try_emplace(key, mesh.vertex_count());
            if (fresh)
                mesh.positions.push_back((mesh.positions[static_cast<std::size_t>(a)] +
                                          mesh.positions[static_cast<std::size_t>(b)])
                                             .normalized());
            return it->second;
        };
        std::vector<Tri> finer;
        for (const Tri& t : mesh.triangles) {
            const int ab = middle(t[0], t[1]), bc = middle(t[1], t[2]), ca = middle(t[2], t[0]);
            finer.insert(finer.end(), {{t[0], ab, ca}, {t[1], bc, ab}, {t[2], ca, bc}, {ab, bc, ca}});
        }
        mesh.triangles = std::move(finer);
    }
    for (Vec3& p : mesh.positions)
        p = centre + radius * p;
    return mesh;
}

/// Closed ring surface about z: rows * columns vertices, twice as many triangles, Euler characteristic 0.
inline TriMesh torus(double major = 3.0, double minor = 1.0, int columns = 24, int rows = 12) {
    TriMesh mesh;
    const double turn = 2.0 * 3.14159265358979323846;
    for (int i = 0; i < columns; ++i)
        for (int j = 0; j < rows; ++j) {
            const double u = turn * i / columns, v = turn * j / rows;
            const double r = major + minor * std::cos(v);
            mesh.positions.emplace_back(r * std::cos(u), r * std::sin(u), minor * std::sin(v));
        }
    const auto at = [&](int i, int j) { return (i % columns) * rows + j % rows; };
    for (int i = 0; i < columns; ++i)
        for (int j = 0; j < rows; ++j) {
            mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    return mesh;
}

/// nx x ny quads of size 1 in the plane z = 0, normals along +z.
inline TriMesh sheet(int nx, int ny) {
    TriMesh mesh;
    for (int j = 0; j <= ny; ++j)
        for (int i = 0; i <= nx; ++i)
            mesh.positions.emplace_back(i, j, 0.0);
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) {
            const int a = j * (nx + 1) + i, b = a + 1, c = a + nx + 2, d = a + nx + 1;
            mesh.triangles.push_back({a, b, c});
            mesh.triangles.push_back({a, c, d});
        }
    return mesh;
}

/// Both meshes in one, the second's vertices after the first's.
inline TriMesh joined(TriMesh a, const TriMesh& b) {
    const int offset = a.vertex_count();
    a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
    for (const Tri& t : b.triangles)
        a.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
    return a;
}

/// The same surface inside out.
inline TriMesh inside_out(TriMesh mesh) {
    for (Tri& t : mesh.triangles)
        std::swap(t[1], t[2]);
    return mesh;
}

} // namespace fascicle::test
