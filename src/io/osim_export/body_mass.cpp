#include "io/osim_export/baked_model.hpp"

#include "fascicle/geometry/bounding_box.hpp"

namespace fascicle::io {
namespace {

std::array<double, 6> inertia_of(const Mat3& second_moment, double density) {
    const Mat3 inertia = density * (second_moment.trace() * Mat3::Identity() - second_moment);
    return {inertia(0, 0), inertia(1, 1), inertia(2, 2), inertia(0, 1), inertia(0, 2), inertia(1, 2)};
}

} // namespace

/// Sums over the tetrahedra (0, a, b, c) of the triangles, D = a . (b x c): volume D / 6, first moment D (a + b + c) / 24, second moment
/// D (s s^T + a a^T + b b^T + c c^T) / 120 with s = a + b + c (Tonon 2005, J. Math. Stat. 1(1)); inertia = tr(C) I - C.
void set_mass(const TriMesh& mesh, double density_kg_m3, BakedBody& body) {
    const BoundingBox box = bounding_box(mesh.positions, mesh.triangles);
    const Vec3 middle = box.empty() ? Vec3(Vec3::Zero()) : Vec3(0.5 * (box.min + box.max));
    double volume = 0;
    Vec3 first = Vec3::Zero();
    Mat3 second = Mat3::Zero();
    for (const Tri& t : mesh.triangles) {
        const Vec3 a = mesh.positions[static_cast<std::size_t>(t[0])] - middle;
        const Vec3 b = mesh.positions[static_cast<std::size_t>(t[1])] - middle;
        const Vec3 c = mesh.positions[static_cast<std::size_t>(t[2])] - middle;
        const Vec3 s = a + b + c;
        const double d = a.dot(b.cross(c));
        volume += d / 6;
        first += d / 24 * s;
        second += d / 120 * (s * s.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose());
    }
    const Vec3 size = box.size();
    const double box_volume = size.prod();
    if (volume > 1e-3 * box_volume && volume > 1e-12 && volume <= box_volume) {
        const Vec3 centre = first / volume;
        const Mat3 central = second - volume * (centre * centre.transpose());
        const Eigen::Vector3d axes(central(0, 0), central(1, 1), central(2, 2));
        if (axes.minCoeff() > 0) {
            body.mass_kg = density_kg_m3 * volume;
            body.mass_centre = middle + centre;
            body.inertia = inertia_of(central, density_kg_m3);
            return;
        }
    }
    // Open, or a sheet: the box, a millimetre thick at least.
    const Vec3 sides = size.cwiseMax(1e-3);
    const double v = sides.prod();
    const Vec3 moments = v / 12 * sides.cwiseProduct(sides);
    body.mass_kg = density_kg_m3 * v;
    body.mass_centre = middle;
    body.inertia = inertia_of(moments.asDiagonal(), density_kg_m3);
}

} // namespace fascicle::io
