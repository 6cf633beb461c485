#include "fascicle/anatomy/ellipsoid_geodesic.hpp"
#include "fascicle/anatomy/wrap_surface.hpp"

namespace fascicle {

WrapContact wrap_ellipsoid(const WrapSurface& ellipsoid, const Vec3& p, const Vec3& q,
                           std::vector<Vec3>* curve) {
    // As a unit sphere: inside and crossing are the same there.
    const Vec3 from = p.cwiseQuotient(ellipsoid.radii), to = q.cwiseQuotient(ellipsoid.radii);
    if (from.norm() < 1 || to.norm() < 1)
        return {WrapOutcome::inside};
    const Vec3 d = to - from;
    const double t = d.squaredNorm() > 0 ? -from.dot(d) / d.squaredNorm() : -1.0;
    if (!(t > 0 && t < 1 && (from + t * d).squaredNorm() < 1))
        return {};
    const EllipsoidPath path =
        ellipsoid_geodesic(ellipsoid.radii, p, q, ellipsoid.side_axis, ellipsoid.side_sign, curve);
    return {WrapOutcome::mandatory, path.first, path.second, path.surface_length};
}

} // namespace fascicle
