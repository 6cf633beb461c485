#include "fascicle/anatomy/geodesic_path.hpp"

#include <limits>

namespace fascicle {

BoneObstacle::BoneObstacle(const TriMesh& mesh) : solid_(mesh), segments_(mesh) {
    normals_.reserve(mesh.triangles.size());
    const auto corner = [&](int v) { return mesh.positions[static_cast<std::size_t>(v)]; };
    for (const Tri& t : mesh.triangles) {
        const Vec3 n = (corner(t[1]) - corner(t[0])).cross(corner(t[2]) - corner(t[0]));
        const double size = n.norm();
        normals_.push_back(size > 0 ? Vec3(n / size) : Vec3::Zero());
    }
}

BoneObstacle::Foot BoneObstacle::foot(const Vec3& x) const {
    const bool inside = solid_.inside(x);
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

} // namespace fascicle
