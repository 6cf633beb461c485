#pragma once
// A region carried over a plane to the other side of the body.

#include "fascicle/geometry/surface_graph.hpp"
#include "fascicle/geometry/surface_region.hpp"

namespace fascicle {

/// normal need not be of unit length, but not zero (FASCICLE_ASSERT).
struct MirrorPlane {
    Vec3 point = Vec3::Zero();
    Vec3 normal = Vec3::UnitX();
};
Vec3 mirrored(const Vec3& p, const MirrorPlane& plane);

/// The region on `to` (the same surface, or its pair) that mirrors `region` on `from`: a vertex of `to` belongs to it when the
/// point of `from` nearest to its mirror image lies within `reach` (scene units) and more than half inside (barycentric mean of
/// the corners, 1 in, 0 out; exactly half counts as inside). On a symmetric surface mirroring twice gives the region back.
SurfaceRegion mirror_region(const SurfaceGraph& from, const SurfaceRegion& region, const SurfaceGraph& to,
                            const MirrorPlane& plane, double reach);

/// Where a stroke's point is mirrored to: the point of `to` nearest to the mirror image; triangle == -1 when none is within reach.
SurfacePoint mirror_point(const Vec3& p, const SurfaceGraph& to, const MirrorPlane& plane, double reach);

} // namespace fascicle
