#include "fascicle/geometry/primitives.hpp"

#include "fascicle/base/assert.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <map>

namespace fascicle {

namespace {

using Node = std::array<int, 3>; // place in the grid of the whole box

class BoxBuilder {
public:
    BoxBuilder(const Vec3& lower, const Vec3& upper, const Node& cells)
        : lower_(lower), upper_(upper), cells_(cells) {}

    TriMesh run() {
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (const bool far : {false, true})
                face(axis, far);
        return std::move(mesh_);
    }

private:
    void face(std::size_t axis, bool far) {
        const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3; // u x v = +axis
        for (int j = 0; j < cells_[v]; ++j)
            for (int i = 0; i < cells_[u]; ++i) {
                const auto corner = [&](int di, int dj) {
                    Node n{};
                    n[axis] = far ? cells_[axis] : 0;
                    n[u] = i + di;
                    n[v] = j + dj;
                    return vertex(n);
                };
                std::array<int, 4> c{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
                if (!far)
                    std::swap(c[1], c[3]);
                const std::size_t s = far == (axis == 2) ? 0 : 1; // which diagonal
                mesh_.triangles.push_back({c[s], c[s + 1], c[s + 2]});
                mesh_.triangles.push_back({c[s], c[s + 2], c[(s + 3) % 4]});
            }
    }

    int vertex(const Node& n) {
        const auto [at, is_new] = number_.try_emplace(n, mesh_.vertex_count());
        if (is_new) {
            Vec3 p;
            for (int a = 0; a < 3; ++a) {
                const double t =
                    static_cast<double>(n[static_cast<std::size_t>(a)]) / cells_[static_cast<std::size_t>(a)];
                p[a] = (1.0 - t) * lower_[a] + t * upper_[a];
            }
            mesh_.positions.push_back(p);
        }
        return at->second;
    }

    Vec3 lower_, upper_;
    Node cells_;
    std::map<Node, int> number_;
    TriMesh mesh_;
};

} // namespace

TriMesh box_mesh(const Vec3& lower, const Vec3& upper, const std::array<int, 3>& cells) {
    FASCICLE_ASSERT(cells[0] >= 1 && cells[1] >= 1 && cells[2] >= 1 && (upper - lower).minCoeff() > 0.0);
    return BoxBuilder(lower, upper, cells).run();
}

TriMesh cylinder_mesh(const Vec3& from, const Vec3& to, double radius, int around, int along) {
    FASCICLE_ASSERT(around >= 3 && along >= 1 && radius > 0.0 && (to - from).squaredNorm() > 0.0);
    const Vec3 axis = (to - from).normalized();
    const Vec3 u = axis.unitOrthogonal(), v = axis.cross(u);
    TriMesh mesh;
    for (int k = 0; k <= along; ++k)
        for (int i = 0; i < around; ++i) {
            const double angle = 2.0 * 3.14159265358979323846 * i / around;
            mesh.positions.push_back(from + (to - from) * k / along +
                                     radius * (std::cos(angle) * u + std::sin(angle) * v));
        }
    const int low = mesh.vertex_count(), high = low + 1;
    mesh.positions.push_back(from);
    mesh.positions.push_back(to);
    for (int i = 0; i < around; ++i) {
        const int j = (i + 1) % around;
        mesh.triangles.push_back({low, j, i});
        for (int k = 0; k < along; ++k) {
            const int a = k * around + i, b = k * around + j;
            mesh.triangles.push_back({a, b, b + around});
            mesh.triangles.push_back({a, b + around, a + around});
        }
        mesh.triangles.push_back({high, along * around + i, along * around + j});
    }
    return mesh;
}

} // namespace fascicle
