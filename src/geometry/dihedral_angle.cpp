#include "fascicle/geometry/dihedral_angle.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace fascicle {

namespace {

/// Unnormalised normals of both wings, or nothing when one of them is too thin to have a direction.
struct WingNormals {
    Vec3 edge;
    double length = 0;
    Vec3 n1, n2;
    double squared1 = 0, squared2 = 0;
};

std::optional<WingNormals> wing_normals(const Vec3& p0, const Vec3& p1, const Vec3& p2, const Vec3& p3) {
    WingNormals w;
    w.edge = p3 - p2;
    const double squared_length = w.edge.squaredNorm();
    w.length = std::sqrt(squared_length);
    w.n1 = (p2 - p0).cross(p3 - p0);
    w.n2 = (p3 - p1).cross(p2 - p1);
    w.squared1 = w.n1.squaredNorm();
    w.squared2 = w.n2.squaredNorm();
    const double least = 1e-12 * squared_length * squared_length;
    // Written so that a NaN, and an edge of no length, count as degenerate too.
    if (!(w.squared1 >= least && w.squared2 >= least && least > 0.0))
        return std::nullopt;
    return w;
}

/// atan2 takes the common factor |N1| |N2| of both arguments out by itself.
double angle_of(const WingNormals& w) {
    return std::atan2(-w.n1.cross(w.n2).dot(w.edge) / w.length, w.n1.dot(w.n2));
}

} // namespace

std::optional<double> signed_dihedral_angle(const Vec3& p0, const Vec3& p1, const Vec3& p2, const Vec3& p3) {
    const auto w = wing_normals(p0, p1, p2, p3);
    if (!w)
        return std::nullopt;
    return angle_of(*w);
}

std::optional<DihedralAngle> dihedral_angle_with_gradient(const Vec3& p0, const Vec3& p1, const Vec3& p2,
                                                          const Vec3& p3) {
    const auto w = wing_normals(p0, p1, p2, p3);
    if (!w)
        return std::nullopt;
    const Vec3 a = w->n1 / w->squared1;
    const Vec3 b = w->n2 / w->squared2;
    const Vec3 along = w->edge / w->length;
    DihedralAngle result;
    result.angle_rad = angle_of(*w);
    result.gradient[0] = w->length * a;
    result.gradient[1] = w->length * b;
    result.gradient[2] = (p0 - p3).dot(along) * a + (p1 - p3).dot(along) * b;
    result.gradient[3] = (p2 - p0).dot(along) * a + (p2 - p1).dot(along) * b;
    return result;
}

std::optional<double> unsigned_dihedral_angle(const Vec3& p0, const Vec3& p1, const Vec3& p2,
                                              const Vec3& p3) {
    const auto w = wing_normals(p0, p1, p2, p3);
    if (!w)
        return std::nullopt;
    const double cosine = w->n1.dot(w->n2) / std::sqrt(w->squared1 * w->squared2);
    return std::acos(std::clamp(cosine, -1.0, 1.0));
}

double wrap_angle(double angle_rad) {
    constexpr double pi = std::numbers::pi;
    const double wrapped = std::remainder(angle_rad, 2.0 * pi);
    return wrapped <= -pi ? pi : wrapped;
}

} // namespace fascicle
