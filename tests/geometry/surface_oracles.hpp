#pragma once
// Brute force against which the fast geometry queries are checked.

#include "fascicle/geometry/closest_point.hpp"
#include "fascicle/geometry/tri_mesh.hpp"
#include "fascicle/geometry/volume.hpp"

#include <algorithm>
#include <cmath>
#include <random>

namespace fascicle::test {

inline TrianglePoint closest_on_triangle(const TriMesh& mesh, const Tri& t, const Vec3& p) {
    const auto at = [&](int v) -> const Vec3& { return mesh.positions[static_cast<std::size_t>(v)]; };
    return closest_point_on_triangle(p, at(t[0]), at(t[1]), at(t[2]));
}

inline double squared_distance(const TriMesh& mesh, const Vec3& p) {
    double best = std::numeric_limits<double>::infinity();
    for (const Tri& t : mesh.triangles)
        best = std::min(best, closest_on_triangle(mesh, t, p).squared_distance);
    return best;
}

/// Negative where the generalised winding number is above 0.5.
inline double signed_distance(const TriMesh& mesh, const Vec3& p) {
    const double d = std::sqrt(squared_distance(mesh, p));
    return winding_number(mesh.positions, mesh.triangles, p) > 0.5 ? -d : d;
}

class Random {
public:
    explicit Random(unsigned seed) : engine_(seed) {}
    double real(double low, double high) {
        return low + (high - low) * (static_cast<double>(engine_()) * 0x1p-32);
    }
    std::size_t index(std::size_t count) { return engine_() % count; }
    Vec3 in_box(const Vec3& low, const Vec3& high) {
        const double x = real(low.x(), high.x()), y = real(low.y(), high.y());
        return {x, y, real(low.z(), high.z())};
    }
    Vec3 direction() {
        for (;;) {
            const Vec3 v = in_box(Vec3::Constant(-1), Vec3::Constant(1));
            if (v.norm() > 0.1 && v.norm() <= 1.0)
                return v.normalized();
        }
    }
    Vec3 on_surface(const TriMesh& mesh) {
        const Tri& t = mesh.triangles[index(mesh.triangles.size())];
        double u = real(0, 1), v = real(0, 1);
        if (u + v > 1.0) {
            u = 1.0 - u;
            v = 1.0 - v;
        }
        const auto at = [&](int k) -> const Vec3& {
            return mesh.positions[static_cast<std::size_t>(t[static_cast<std::size_t>(k)])];
        };
        return at(0) + u * (at(1) - at(0)) + v * (at(2) - at(0));
    }

private:
    std::mt19937 engine_;
};

} // namespace fascicle::test
