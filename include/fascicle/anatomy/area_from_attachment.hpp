#pragma once
// The area on a bone that belongs to an attachment given as vertices of the muscle: the way back of attached_vertices.hpp.

#include "fascicle/anatomy/attachment_area.hpp"

namespace fascicle {

/// Vertices of the bone under the part of the muscle's surface whose corners are all attached, within `tolerance` (scene units)
/// of it, as area_from_patch. Empty when the attached vertices span no triangle.
SurfaceRegion area_from_attachment(const SurfaceGraph& bone, const TriMesh& muscle,
                                   const Attachment& attachment, double tolerance);

} // namespace fascicle
