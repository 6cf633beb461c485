#pragma once
// What is wrong with a triangle surface, and mending of what is harmless to mend.

#include "fascicle/geometry/mesh_topology.hpp"
#include "fascicle/geometry/tri_mesh.hpp"

#include <string>

namespace fascicle {

/// Counts of findings; zero everywhere is a closed, manifold, outward-oriented surface with no surplus.
/// Vertex and triangle numbers are 0-based; "first" ones are -1 when there is none.
struct MeshReport {
    int vertices = 0;
    int triangles = 0; ///< after mending, when mended

    // Not to be used at all (usable() is false).
    int non_finite_points = 0;
    int first_non_finite_point = -1;
    int bad_triangles = 0; ///< with an index outside [0, vertices)
    int first_bad_triangle = -1;

    // Harmless: mend() has done away with them, and the counts say how many there were.
    int degenerate_triangles = 0;   ///< with a repeated index; dropped
    int duplicate_triangles = 0;    ///< same three vertices, same orientation as an earlier one; dropped
    int inconsistent_triangles = 0; ///< against the orientation of most of their patch; flipped
    int inverted_components = 0; ///< closed parts with negative volume, not cavities of another part; flipped

    // Left as they are.
    int zero_area_triangles =
        0; ///< distinct indices, |N|^2 <= 1e-12 l^4 (N = cross product, l = longest edge)
    int opposite_duplicates = 0;  ///< same three vertices as an earlier one, other orientation
    int boundary_edges = 0;       ///< edges with one triangle
    int holes = 0;                ///< connected chains of boundary edges
    Edge first_boundary_edge;     ///< {-1, -1} when there is none
    int nonmanifold_edges = 0;    ///< edges with more than two triangles
    Edge first_nonmanifold_edge;  ///< {-1, -1} when there is none
    int nonmanifold_vertices = 0; ///< vertices whose triangles are more than one fan
    int first_nonmanifold_vertex = -1;
    int unbalanced_edges = 0;       ///< edges not walked equally often in both directions
    Edge first_unbalanced_edge;     ///< {-1, -1} when there is none
    int non_orientable_patches = 0; ///< patches that no flipping makes consistent (Moebius strip)
    int cavities = 0;               ///< closed parts with negative volume inside a part with positive volume
    int components = 0;             ///< parts connected through shared vertices
    int unused_vertices = 0;
    int duplicate_vertices = 0; ///< used vertices at exactly the position of an earlier used one

    bool usable() const { return non_finite_points == 0 && bad_triangles == 0; }
    /// Whether every directed edge is balanced by its opposite, so that the surface bounds a volume and the
    /// winding number is an integer off the surface. Four triangles at one edge, balanced, still count as
    /// closed.
    bool closed() const { return usable() && triangles > 0 && unbalanced_edges == 0; }
    /// Every finding as one line of text, the serious ones first; empty when there is nothing to say.
    std::vector<std::string> lines() const;
};

struct MendedMesh {
    TriMesh mesh;
    MeshReport report;
};

/// Drops triangles with repeated indices and same-oriented duplicates, makes the orientation consistent
/// (breadth-first over edges with two triangles, the larger part of each patch decides), and turns closed
/// parts outwards (a part with negative volume inside another one is a cavity and stays). Vertex count and
/// order never change, nor the order of the triangles that stay. A mesh that is not usable() is returned as
/// it came.
MendedMesh mend(TriMesh mesh);

/// The report of mend() without its result.
MeshReport check_mesh(const TriMesh& mesh);

/// Error unless the surface can be a muscle: usable, at least one triangle, closed. `where` is the file's
/// name.
void require_muscle_surface(const MeshReport& report, const std::string& where);

/// Error unless the surface can be a bone: usable, at least 4 triangles. Holes are allowed and only reported.
void require_bone_surface(const MeshReport& report, const std::string& where);

} // namespace fascicle
