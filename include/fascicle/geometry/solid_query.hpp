#pragma once
// Exact signed distance of single points to the solid that a surface bounds: the reference beside
// DistanceGrid.

#include "fascicle/geometry/bvh.hpp"
#include "fascicle/geometry/winding_number.hpp"

#include <cmath>

namespace fascicle {

/// Negative inside = generalised winding number > 0.5 (WindingNumber::inside). Queries are const, allocate
/// nothing and may run on several threads.
class SolidQuery {
public:
    SolidQuery() = default;
    explicit SolidQuery(const TriMesh& mesh) : bvh_(mesh), winding_(mesh) {}

    /// Exact distance to the surface, scene units, negative inside. Farther than max_distance from the
    /// surface: +-max_distance. hint: a triangle that is probably near, or -1; receives the nearest one.
    double signed_distance(const Vec3& p, double max_distance, int& hint) const {
        const double d2 = bvh_.closest_squared_distance(p, max_distance, hint);
        const double d = d2 < max_distance * max_distance ? std::sqrt(d2) : max_distance;
        return winding_.inside(p) ? -d : d;
    }
    double signed_distance(const Vec3& p,
                           double max_distance = std::numeric_limits<double>::infinity()) const {
        int hint = -1;
        return signed_distance(p, max_distance, hint);
    }
    bool inside(const Vec3& p) const { return winding_.inside(p); }

    const TriangleBvh& bvh() const { return bvh_; }
    const WindingNumber& winding() const { return winding_; }

private:
    TriangleBvh bvh_;
    WindingNumber winding_;
};

} // namespace fascicle
