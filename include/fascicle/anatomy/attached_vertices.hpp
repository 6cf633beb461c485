#pragma once
// The muscle vertices that an area on a bone holds: a preview of what will be fixed.

#include "fascicle/anatomy/attach.hpp"
#include "fascicle/geometry/geodesic_search.hpp"
#include "fascicle/geometry/surface_region.hpp"

namespace fascicle {

struct AttachedVertex {
    int vertex = -1;          ///< of the muscle
    double distance = 0;      ///< to the bone, scene units
    Vec3 foot = Vec3::Zero(); ///< the nearest point of the bone
    bool in_border = false;   ///< the foot lies outside of the area, within the border
};

/// Ascending by vertex. A vertex is held when the nearest point of the bone (whole bone, so a muscle on the far side of a
/// blade is not held) is at most rules.bone away and lies in the area or at most rules.border, along the surface, beyond its
/// border: the counterpart of attach_by_outline for a closed outline, with lengths measured on the bone instead of in a plane. A point lies in a set of
/// vertices when the barycentric mean of its triangle's corners (1 in, 0 out) is at least 1/2.
/// area: of bone.graph() (FASCICLE_ASSERT); empty holds nothing.
std::vector<AttachedVertex> attached_vertices(const SurfaceRegion& area, GeodesicSearch& bone,
                                              const TriMesh& muscle, const AttachRules& rules);

/// Their numbers alone.
std::vector<int> vertices_of(const std::vector<AttachedVertex>& attached);

} // namespace fascicle
