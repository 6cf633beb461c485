#include "fascicle/geometry/solid_query.hpp"

#include "boundary_cap.hpp"
#include "fascicle/geometry/bounding_box.hpp"
#include "fascicle/geometry/volume.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fascicle {

SolidQuery::SolidQuery(const TriMesh& mesh) : bvh_(mesh), winding_(mesh) {
    const BoundingBox box = bounding_box(mesh.positions, mesh.triangles);
    low_ = box.min;
    high_ = box.max;
    const TriMesh cap = boundary_cap(mesh.positions, mesh.triangles);
    cap_ = TriangleBvh(cap);
    // |w(cap)| <= area / (4 pi d^2) at distance d.
    cap_reach_ = std::sqrt(surface_area(cap.positions, cap.triangles) / (4.0 * std::numbers::pi * 0.49));
}

bool SolidQuery::inside(const Vec3& p) const {
    return !beyond_box(p) && winding_.inside(p);
}

double SolidQuery::clear_radius(const Vec3& p, double distance) const {
    if (closed())
        return distance;
    // w(surface) = n - w(cap), with n an integer that changes only across surface and cap: farther than
    // cap_reach_ from the cap "inside" means n >= 1, and stays as it is until the surface or that zone is met.
    int hint = -1;
    const double reach = distance + cap_reach_;
    const double to_cap = std::sqrt(cap_.closest_squared_distance(p, reach, hint));
    return std::max(0.0, std::min(distance, to_cap - cap_reach_));
}

SolidSide SolidQuery::side(const Vec3& p, double max_distance, int& hint, int known_inside) const {
    const double d2 = bvh_.closest_squared_distance(p, max_distance, hint);
    const double d = d2 < max_distance * max_distance ? std::sqrt(d2) : max_distance;
    const bool in = known_inside < 0 ? inside(p) : known_inside > 0;
    return {in ? -d : d, clear_radius(p, d)};
}

double SolidQuery::signed_distance(const Vec3& p, double max_distance, int& hint) const {
    const double d2 = bvh_.closest_squared_distance(p, max_distance, hint);
    const double d = d2 < max_distance * max_distance ? std::sqrt(d2) : max_distance;
    return inside(p) ? -d : d;
}

} // namespace fascicle
