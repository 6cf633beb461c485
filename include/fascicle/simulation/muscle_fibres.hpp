#pragma once
// The fibres of a scene's muscles, as its parameters ask for them.

#include "fascicle/geometry/mesh_topology.hpp"
#include "fascicle/scene/recording.hpp"

namespace fascicle {

/// Where a muscle is held, as fibres need it: one patch per attachment, of kind origin or insertion (one of unknown kind counts by
/// whether its bone moves), with the outline it was made from where there is exactly one.
std::vector<AttachmentPatch> fibre_patches(const Scene& scene, const Muscle& muscle,
                                           const std::vector<Attachment>& attachments);

/// Fibres of one muscle by `fibres.method`, `.template`, `.count` and `.segments` of the scene; null when the method is "none".
/// rest: the muscle's surface in frame 0, with the triangles of its mesh. Error naming the muscle, and the attachment where it is
/// about one, when they cannot be made.
FibreModelPtr make_fibres(const Scene& scene, const Muscle& muscle, const TriMesh& rest,
                          const MeshTopology& topology, const std::vector<Attachment>& attachments,
                          int threads);

} // namespace fascicle
