#pragma once
// Attachment areas on a muscle: the inside of an outline projected on it, cut out of the mesh.

#include "fascicle/anatomy/fibre_problem.hpp"

namespace fascicle {

/// On which side of an outline the vertices lie. offset: signed distance to the projected outline for vertices near it,
/// negative inside, NaN elsewhere; inside: every vertex. failure: empty, or why the outline bounds no area, as a clause
/// ("it is an open line").
struct OutlineSide {
    std::vector<double> offset;
    std::vector<char> inside;
    std::string failure;
};

/// Projects a closed outline on the surface, decides the side of the vertices within two and a half edges of it by the
/// nearest piece, and lets every other vertex take the side that it can be reached from. Of the two parts the one with
/// fewer vertices is inside. normals: V, of the surface. Fails (see failure) for an open line, one that lies more than
/// 15 mm off the muscle on average, one that bounds nothing or twists, and one whose inside and the patch's vertices
/// have little in common.
OutlineSide side_of_outline(const FibreProblem& problem, const AttachmentPatch& patch, const Points& normals);

/// A working copy of a surface: the original vertices, then new ones on cut edges.
struct CutSurface {
    TriMesh mesh;
    std::vector<int> patch; ///< per vertex: number of the patch it belongs to, or -1
};

/// Cuts triangles along offset = 0 of each side (null: the patch's own vertices, no cut) and labels vertices inside or on
/// the cut. Cuts within a tenth of an edge from a vertex go through the vertex. A vertex of several patches belongs to
/// the first.
CutSurface cut_surface(const FibreProblem& problem, std::vector<OutlineSide>& sides);

} // namespace fascicle
