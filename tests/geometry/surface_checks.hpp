#pragma once
// Properties of surfaces that tests of meshing share, each computed the plain way.

#include "fascicle/geometry/tri_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace fascicle::test {

struct SurfaceReport {
    bool closed = true;  // every directed edge once, and its reverse once
    bool one_fan = true; // the triangles round every vertex are one fan
    int euler = 0;       // V - E + F of the used vertices
    double volume = 0.0;
    double min_angle_deg = 180.0;
    double mean_quality = 0.0; // 4 sqrt(3) area / sum of squared sides: 1 for equilateral
    double longest_edge = 0.0, shortest_edge = 1e300;
};

inline SurfaceReport report(const TriMesh& mesh) {
    SurfaceReport r;
    std::map<std::pair<int, int>, int> edges;
    std::map<int, std::map<int, int>> fans; // vertex -> spoke -> next spoke
    for (const Tri& t : mesh.triangles) {
        double squares = 0.0;
        const auto at = [&](std::size_t k) -> const Vec3& {
            return mesh.positions[static_cast<std::size_t>(t[k % 3])];
        };
        const Vec3 n = (at(1) - at(0)).cross(at(2) - at(0));
        for (std::size_t k = 0; k < 3; ++k) {
            if (++edges[{t[k], t[(k + 1) % 3]}] > 1)
                r.closed = false;
            fans[t[k]][t[(k + 1) % 3]] = t[(k + 2) % 3];
            const Vec3 e = at(k + 1) - at(k), f = at(k + 2) - at(k);
            squares += e.squaredNorm();
            r.longest_edge = std::max(r.longest_edge, e.norm());
            r.shortest_edge = std::min(r.shortest_edge, e.norm());
            const double angle = std::atan2(e.cross(f).norm(), e.dot(f)) * 180.0 / 3.14159265358979323846;
            r.min_angle_deg = std::min(r.min_angle_deg, angle);
        }
        r.volume += at(0).dot(at(1).cross(at(2))) / 6.0;
        r.mean_quality += 2.0 * std::sqrt(3.0) * n.norm() / squares / mesh.triangle_count();
    }
    for (const auto& [edge, count] : edges)
        if (count != 1 || edges.count({edge.second, edge.first}) != 1)
            r.closed = false;
    for (const auto& [v, fan] : fans) {
        std::size_t steps = 0;
        int at = fan.begin()->first;
        do {
            const auto step = fan.find(at);
            if (step == fan.end())
                break;
            at = step->second;
            ++steps;
        } while (at != fan.begin()->first && steps <= fan.size());
        if (steps != fan.size())
            r.one_fan = false;
    }
    r.euler = static_cast<int>(fans.size()) - static_cast<int>(edges.size() / 2) + mesh.triangle_count();
    return r;
}

} // namespace fascicle::test
