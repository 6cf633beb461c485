#include "solver/contact/plane_contact.hpp"

namespace fascicle::solver {

bool hold_to_plane(const PointPlane& plane, int point, int substep, int substeps, GuardedPoints& points,
                   std::span<const ContactSolid> solids, const ContactSettings& settings,
                   GuardCounts& counts) {
    if (!points.is_free(point))
        return false;
    const double share = double(substep + 1) / substeps;
    const Vec3 x = points.now(point), p = plane.from + share * (plane.to - plane.from);
    const double least = plane.least_from + share * (plane.least_to - plane.least_from);
    const double room = (x - p).dot(plane.normal) - least;
    if (!(room < 0.0))
        return false;
    const Vec3 way = points.way(point);
    const double plane_way =
        ((plane.to - plane.from).dot(plane.normal) + plane.least_to - plane.least_from) / substeps;
    // No normal: the volume and the coarse step must not take the plane for a wall that holds, since what is behind it gives way. Taken
    // for one, two muscles drive each other apart, further each time.
    points.put(point, x - room * plane.normal, Vec3::Zero(), false);
    points.set_way(point, way + (plane_way - way.dot(plane.normal)) * plane.normal);
    guard_point(points, point, solids, false, settings, counts);
    return true;
}

} // namespace fascicle::solver
