#include "solver/contact/plane_contact.hpp"

namespace fascicle::solver {

bool hold_to_plane(const PointPlane& plane, int point, double share, GuardedPoints& points,
                   std::span<const ContactSolid> solids, const ContactSettings& settings,
                   GuardCounts& counts) {
    if (!points.is_free(point))
        return false;
    const Vec3 x = points.now(point), p = plane.from + share * (plane.to - plane.from);
    const double room = (x - p).dot(plane.normal) - plane.least;
    if (!(room < 0.0))
        return false;
    points.put(point, x - room * plane.normal, plane.normal, false);
    guard_point(points, point, solids, false, settings, counts);
    return true;
}

} // namespace fascicle::solver
