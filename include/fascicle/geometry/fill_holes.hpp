#pragma once
// Closes small holes of a surface with triangles between the vertices of their borders.

#include "fascicle/geometry/tri_mesh.hpp"

#include <functional>

namespace fascicle {

struct HoleFilling {
    TriMesh mesh; ///< the same vertices; new triangles behind the old ones
    int filled = 0;
    int left = 0;            ///< holes that stay: too long, or not a simple ring
    int triangles = 0;       ///< added
    double added_area = 0;   ///< square units of the mesh
    double surface_area = 0; ///< of all triangles, the new ones included
};

/// Of every ring of border edges with 3 to max_edges edges the triangulation that minimises the sum over its triangles of
/// area + 0.001 (sum of the squared edges), found by dynamic programming (Barequet & Sharir 1995, "Filling gaps in the
/// boundary of a polyhedron"; the second term keeps slivers out where areas are alike). No edge that the mesh has already is
/// used a second time, so that no edge gets more than two triangles. Holes that touch themselves or each other in a
/// vertex stay. Orientation follows the neighbours, which must be consistent (mend()).
/// wanted: asked for each ring that is short enough, as its vertices in order; empty: all are.
HoleFilling fill_holes(const TriMesh& mesh, int max_edges = 100,
                       const std::function<bool(const std::vector<int>& ring)>& wanted = {});

} // namespace fascicle
