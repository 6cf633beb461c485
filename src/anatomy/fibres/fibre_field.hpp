#pragma once
// What the template methods start from: a checked problem, and a harmonic field from origin to insertion.

#include "anatomy/fibres/outline_cut.hpp"

namespace fascicle {

/// The whole message is about this muscle: "gluteus_maximus: fibres".
std::string fibre_error_place(const FibreProblem& problem);
std::string fibre_error_place(const FibreProblem& problem, const AttachmentPatch& patch);

/// Errors (naming muscle and attachment) unless: counts are in range, the surface is finite, has triangles and is closed,
/// there is an origin and an insertion, vertices are in range, and some part of the surface has both kinds and a free
/// vertex. Vertices claimed by both kinds belong to neither: returns the problem without them, with a note.
FibreProblem checked_problem(const FibreProblem& problem, std::vector<std::string>& notes);

/// values: per vertex of the cut surface, 0 on origins, 1 on insertions, harmonic between; vertices in parts without both
/// keep -1.
struct FibreField {
    CutSurface surface;
    MeshTopology topology; ///< of the cut surface
    std::vector<double> values;
    double cut_seconds = 0, field_seconds = 0;
    std::vector<std::string> notes;

    /// By vertex of the problem's surface, parts without a field 0.
    std::vector<double> at_original(std::size_t vertices) const;
};

FibreField solve_fibre_field(const FibreProblem& checked);

/// The attached part of the muscle for each kind, as triangles of the problem's surface: those whose corners are all
/// attached; edges and single vertices outside of them as triangles without area.
std::vector<Tri> attached_triangles(const FibreProblem& problem, AttachmentKind kind);

} // namespace fascicle
