#pragma once
// A muscle's surface where there is none: a spindle about the path of a line muscle.

#include "fascicle/geometry/solid_query.hpp"
#include "fascicle/geometry/tri_mesh.hpp"

#include <memory>

namespace fascicle {

struct SpindleRequest {
    Points path;       ///< two points at least, from origin to insertion, of some length
    double volume = 0; ///< > 0, the path's unit cubed
    /// The spindle keeps out of these by `clearance`: its axis is pushed aside, and what is left is flattened against them.
    std::vector<std::shared_ptr<const SolidQuery>> bones;
    double clearance = 0;
    int around = 24; ///< vertices of a ring, 6 at least
};

/// Closed, manifold, outward. Cross-sections are circles of area
///   A(s) = A_max (e + (1 - e) sin^2(pi s / L)), e = 0.12,
/// so that the volume L A_max (1 + e) / 2 is the wanted one; A_max is corrected until the mesh itself has it within 0.1 %
/// (2 % where bones flatten it).
struct Spindle {
    TriMesh mesh;
    std::vector<int> origin,
        insertion;            ///< vertices of the caps and of the first and last 3 % of the path, ascending
    double length = 0;        ///< of the axis
    double radius = 0;        ///< at the thickest
    double largest_shift = 0; ///< of the axis from the path
    int inside = 0;           ///< vertices that are still inside a bone
    double volume = 0;        ///< of the mesh
};
Spindle make_spindle(const SpindleRequest& request);

/// Muscle volume that a model implies: PCSA times optimal fibre length, PCSA = peak isometric force / specific tension, m^3.
/// Specific tension 60 N/cm^2 (Rajagopal et al. 2016, IEEE Trans. Biomed. Eng. 63:2068).
double line_muscle_volume_m3(double force_n, double optimal_fibre_length_m);

} // namespace fascicle
