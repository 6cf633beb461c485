#pragma once
// Exact signed distance of single points to the solid that a surface bounds: the reference beside
// DistanceGrid.

#include "fascicle/geometry/bvh.hpp"
#include "fascicle/geometry/winding_number.hpp"

namespace fascicle {

/// Distance and side of a point. radius: in the open ball of this radius around the point nothing is on the
/// other side; equal to |distance| for a closed surface, may be smaller, down to 0, near the holes of an open
/// one.
struct SolidSide {
    double distance = 0; ///< scene units, negative inside
    double radius = 0;
};

/// Negative inside = generalised winding number > 0.5 (WindingNumber::inside). Queries are const, allocate
/// nothing and may run on several threads.
class SolidQuery {
public:
    SolidQuery() = default;
    explicit SolidQuery(const TriMesh& mesh);

    /// Exact distance to the surface, scene units, negative inside. Farther than max_distance from the
    /// surface: +-max_distance. hint: a triangle that is probably near, or -1; receives the nearest one.
    double signed_distance(const Vec3& p, double max_distance, int& hint) const;
    double signed_distance(const Vec3& p,
                           double max_distance = std::numeric_limits<double>::infinity()) const {
        int hint = -1;
        return signed_distance(p, max_distance, hint);
    }
    bool inside(const Vec3& p) const;
    /// Whether p is outside by the box alone: true says that inside(p) is false, false says nothing.
    bool beyond_box(const Vec3& p) const {
        // The winding number of a closed surface vanishes outside of its box, exactly.
        return closed() && !((p.array() >= low_.array()).all() && (p.array() <= high_.array()).all());
    }

    /// signed_distance with the radius, for callers that move a point and ask again. known_inside: the answer
    /// of inside(p) when the caller can tell, saving its cost; -1: unknown.
    SolidSide side(const Vec3& p, double max_distance, int& hint, int known_inside = -1) const;
    /// The radius alone, at a point with the given distance to the surface (or a lower bound of it).
    double clear_radius(const Vec3& p, double distance) const;

    const TriangleBvh& bvh() const { return bvh_; }
    const WindingNumber& winding() const { return winding_; }
    /// Whether every edge is balanced, doubled vertices counted as one.
    bool closed() const { return cap_.triangle_count() == 0; }

private:
    TriangleBvh bvh_;
    WindingNumber winding_;
    TriangleBvh cap_; ///< what closes the surface (boundary_cap)
    Vec3 low_ = Vec3::Zero(), high_ = Vec3::Zero();
    double cap_reach_ = 0; ///< farther than this from the cap its winding number is below a half
};

} // namespace fascicle
