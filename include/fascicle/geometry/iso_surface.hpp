#pragma once
// The zero surface of an implicit solid as a closed triangle mesh.

#include "fascicle/geometry/implicit_field.hpp"
#include "fascicle/geometry/remesh.hpp"
#include "fascicle/geometry/tri_mesh.hpp"

namespace fascicle {

/// Marching tetrahedra over the field: every cell is cut into six tetrahedra round its diagonal from corner
/// 000 to corner 111 (H. Freudenthal 1942; J. Bloomenthal 1994 for the polygons). Closed, manifold and
/// outward by construction: each edge has two triangles in opposite directions, and the volume is positive.
/// Vertices keep at least 5 % of an edge away from the nodes, so that no triangle is without area. Empty when
/// the field has no inside.
TriMesh extract_iso_surface(const ImplicitField& field);

/// The connected part with the most triangles, vertices renumbered in their order.
TriMesh largest_component(const TriMesh& mesh);

struct ImplicitMeshOptions {
    int triangles = 0; ///< wanted count (see RemeshOptions); > 0
    int rounds = 4;    ///< remeshing rounds
    int threads = 1;
};

/// Extracts the surface of the field, keeps its largest part, remeshes to the wanted count and moves every vertex to
/// the zero surface of f itself, which the field must be sampled from. Closed, manifold, outward; even number of
/// triangles. Throws Error when f has no inside in the box.
TriMesh mesh_implicit(const Implicit& f, const ImplicitField& field, const ImplicitMeshOptions& options);

} // namespace fascicle
