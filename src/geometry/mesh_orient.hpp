#pragma once
// Private to mesh_check: makes the orientation of a triangle list consistent and turns closed parts outwards.

#include "fascicle/geometry/mesh_topology.hpp"
#include "fascicle/geometry/tri_mesh.hpp"

namespace fascicle::detail {

struct OrientationChanges {
    int inconsistent_triangles = 0;
    int non_orientable_patches = 0;
    int inverted_components = 0;
    int cavities = 0;
    bool turned = false;   ///< whether any triangle is now the other way round
    MeshTopology topology; ///< of the triangles as they came: holds if none was turned
};

/// Indices must be in range and no triangle may repeat one. Flipping swaps a triangle's last two corners.
OrientationChanges orient(TriMesh& mesh);

} // namespace fascicle::detail
