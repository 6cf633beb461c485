#pragma once
// A bone or muscle gets another mesh of the same shape: repaired, smoothed, remeshed.

#include "fascicle/document/document.hpp"
#include "fascicle/geometry/repair/vertex_origin.hpp"

namespace fascicle::actions {

/// Vertices that were chosen on the old mesh (fixed to a bone, or in an area) and on the new one.
struct CarriedVertices {
    int before = 0, after = 0;
};

/// One undo step, "Repair muscle iliacus". mesh: not null, closed; origins: one per vertex of it, over the old mesh's vertices.
/// A new vertex is fixed where its nearest old one was; outlines and fibres are places in space and stay. The file's hash is
/// forgotten: the mesh is no longer what the file holds, so a project carries it.
CarriedVertices replace_muscle_mesh(Document& document, int muscle, MeshPtr mesh,
                                    const std::vector<VertexOrigin>& origins);
/// The same for a bone, with the areas of all muscles on it. Areas that were made for another mesh stay as they are.
CarriedVertices replace_bone_mesh(Document& document, int bone, MeshPtr mesh,
                                  const std::vector<VertexOrigin>& origins);

} // namespace fascicle::actions
