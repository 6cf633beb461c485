#include "fascicle/geometry/region_mirror.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/geometry/bounding_box.hpp"

namespace fascicle {

Vec3 mirrored(const Vec3& p, const MirrorPlane& plane) {
    const double squared = plane.normal.squaredNorm();
    FASCICLE_ASSERT(squared > 0.0);
    return p - (2.0 * (p - plane.point).dot(plane.normal) / squared) * plane.normal;
}

SurfaceRegion mirror_region(const SurfaceGraph& from, const SurfaceRegion& region, const SurfaceGraph& to,
                            const MirrorPlane& plane, double reach) {
    FASCICLE_ASSERT(region.vertex_count() == from.vertex_count() && reach >= 0.0);
    SurfaceRegion result(to.vertex_count());
    // Points whose nearest surface is inside lie within reach of a triangle that has a corner in the region.
    BoundingBox box;
    region.for_each([&](int v) {
        for (const int t : from.topology().vertex_triangles(v))
            for (const int corner : from.triangle(t))
                box.add(from.position(corner));
    });
    if (box.empty())
        return result;
    const Vec3 margin = Vec3::Constant(reach);
    const Vec3 low = box.min - margin, high = box.max + margin;
    for (int v = 0; v < to.vertex_count(); ++v) {
        const Vec3 p = mirrored(to.position(v), plane);
        if ((p.array() < low.array()).any() || (p.array() > high.array()).any() ||
            to.topology().vertex_component(v) < 0)
            continue;
        const SurfacePoint foot = from.tree().closest(p, reach * (1.0 + 1e-12) + 1e-300);
        if (foot.triangle < 0)
            continue;
        double inside = 0;
        const Tri& tri = from.triangle(foot.triangle);
        for (std::size_t k = 0; k < 3; ++k)
            inside += region.contains(tri[k]) ? foot.weights[static_cast<Eigen::Index>(k)] : 0.0;
        if (inside >= 0.5 - 1e-9)
            result.insert(v);
    }
    return result;
}

SurfacePoint mirror_point(const Vec3& p, const SurfaceGraph& to, const MirrorPlane& plane, double reach) {
    return to.tree().closest(mirrored(p, plane), reach * (1.0 + 1e-12) + 1e-300);
}

} // namespace fascicle
