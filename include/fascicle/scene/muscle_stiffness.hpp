#pragma once
// Fields on a muscle's surface that follow from its scene: from origin to insertion, along its fibres, how stiff its edges are.

#include "fascicle/anatomy/fibre_problem.hpp"
#include "fascicle/geometry/mesh_topology.hpp"
#include "fascicle/scene/scene.hpp"

namespace fascicle {

/// V values, harmonic on the surface: 0 on origins, 1 on insertions (attachment_end). Empty when the attachments are not of both
/// ends.
std::vector<double> origin_to_insertion_field(const Scene& scene, const Muscle& muscle,
                                              const MeshTopology& topology,
                                              const std::vector<Attachment>& attachments);

/// Unit tangents of the fibres at each edge, zero where none is known: from the superficial fibres, else from the muscle's `fibres`
/// (null: it has none), else from the harmonic field between origin and insertion when `harmonic` allows. Empty when there is
/// neither.
Points muscle_edge_tangents(const Scene& scene, const Muscle& muscle, const MeshTopology& topology,
                            const std::vector<Attachment>& attachments, const FibreModel* fibres,
                            bool harmonic);

/// Stiffness of an edge whose spring constant is multiplied by `softness` > 0, as the share of its error that one projection
/// removes in the published substep. xpbd: k s / (1 - k + k s), from alpha = h^2 W (1 - k) / k and the spring constant s / alpha
/// (solver/compliance.hpp); classic: k s (Cervenka & Kohout 2020, eq. 5). Within [0, 1].
double softened_stiffness(double stiffness, double softness, bool classic);

/// softened_stiffness of every edge (E) for the scene's parameters.
std::vector<double> edge_stiffness(const Scene& scene, const Muscle& muscle, const MeshTopology& topology,
                                   const std::vector<Attachment>& attachments, const FibreModel* fibres);

} // namespace fascicle
