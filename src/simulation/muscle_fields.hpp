#pragma once
// Fields on a muscle's surface that follow from its attachments: alignment of edges and carry weights.

#include "fascicle/geometry/mesh_topology.hpp"
#include "fascicle/scene/muscle_stiffness.hpp"
#include "fascicle/scene/recording.hpp"
#include "simulation/resolve_attachments.hpp"

namespace fascicle {

/// (u . v)^2 per edge, u its direction at rest, v its tangent; 0 where the tangent is zero. Empty without tangents.
std::vector<double> edge_alignment(const TriMesh& mesh, const MeshTopology& topology, const Points& tangents);

/// V x B shares of each bone: harmonic between the attachments, 1 on those of the bone, 0 on those of others; rows sum to 1. Empty
/// without attachments.
std::vector<double> muscle_bone_shares(const Muscle& muscle, const MeshTopology& topology,
                                       const std::vector<Attachment>& attachments, std::size_t bones);

/// V x B shares of each bone's motion that a vertex is predicted to follow: those of muscle_bone_shares, columns of bones at rest
/// zero. A muscle without attachments (no shares) lies loosely between the bones: there the share falls with the distance,
/// w_b = (1/d_b) / sum_c (1/d_c).
std::vector<double> muscle_carry_weights(const Muscle& muscle, std::vector<double> shares,
                                         const std::vector<BoneQuery>& bones);

} // namespace fascicle
