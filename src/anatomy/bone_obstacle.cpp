#include "fascicle/anatomy/geodesic_path.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle {

BoneObstacle::BoneObstacle(const TriMesh& mesh) : solid_(mesh) {
    normals_.reserve(mesh.triangles.size());
    const auto corner = [&](int v) { return mesh.positions[static_cast<std::size_t>(v)]; };
    for (const Tri& t : mesh.triangles) {
        const Vec3 n = (corner(t[1]) - corner(t[0])).cross(corner(t[2]) - corner(t[0]));
        const double size = n.norm();
        normals_.push_back(size > 0 ? Vec3(n / size) : Vec3::Zero());
    }
}

BoneObstacle::Foot BoneObstacle::make_foot(const Vec3& x, bool inside) const {
    const SurfacePoint near = solid_.bvh().closest(x);
    Foot foot;
    if (near.triangle < 0) {
        foot.distance = std::numeric_limits<double>::infinity();
        return foot;
    }
    foot.point = near.point;
    const Vec3 away = inside ? Vec3(near.point - x) : Vec3(x - near.point);
    const double size = away.norm();
    foot.distance = inside ? -size : size;
    const Vec3& normal = normals_[static_cast<std::size_t>(near.triangle)];
    // On the surface, to rounding, only the triangle tells what is out.
    foot.outward = size > 1e-9 * (1e-3 + near.point.cwiseAbs().maxCoeff()) ? Vec3(away / size) : normal;
    return foot;
}

BoneObstacle::Foot BoneObstacle::foot(const Vec3& x) const {
    return make_foot(x, solid_.inside(x));
}

BoneObstacle::Foot BoneObstacle::foot_outside(const Vec3& x) const {
    return make_foot(x, false);
}

double segment_clearance(const Vec3& a, const Vec3& b, std::span<const PlacedObstacle> obstacles,
                         double precision) {
    double least = std::numeric_limits<double>::infinity();
    const double length = (b - a).norm();
    for (const PlacedObstacle& obstacle : obstacles) {
        const Vec3 p = obstacle.pose.apply_inverse(a), q = obstacle.pose.apply_inverse(b);
        double lowest = std::numeric_limits<double>::infinity();
        // In the ball of radius |distance| nothing nearer than 0 can be; steps beyond `lowest` find nothing lower.
        for (double s = 0;;) {
            const double here = obstacle.bone->distance(p + (length > 0 ? s / length : 0.0) * (q - p));
            lowest = std::min(lowest, here);
            if (s >= length)
                break;
            s = std::min(length, s + std::max(precision, here - lowest + precision));
        }
        least = std::min(least, lowest - precision);
    }
    return least;
}

} // namespace fascicle
