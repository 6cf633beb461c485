#pragma once
// The architecture of one muscle in one pose: pennation, cross-section, how much of the muscle its fibres fill.

#include "fascicle/anatomy/fibre_shape.hpp"

namespace fascicle {

/// How the line of action at one end of a muscle is found.
struct PennationOptions {
    /// Part of a fibre's length, from its end, whose mean tangent counts: 0.15 to 0.20 (Lee et al. 2014).
    double end_share = 0.2;
    /// The ends lie on a tendon when their principal axis explains more than this share of their scatter.
    double axis_r2 = 0.95;
    /// ... and runs within this angle of the mean tangent. Ours: the ends of a broad muscle without pennation lie
    /// on a line too (the origin of a strap), but across it.
    double axis_within_rad = 0.7853981633974483;
};

/// A line with a unit direction from origin to insertion, in the coordinates of the fibres.
struct LineOfAction {
    Vec3 point = Vec3::Zero();     ///< mean of the ends
    Vec3 direction = Vec3::Zero(); ///< zero when there is none (no fibre with a length)
    double axis_r2 = 0;      ///< share of the ends' scatter along their principal axis; NaN without scatter
    bool along_ends = false; ///< the ends' principal axis, not the mean tangent
};

/// Mean tangent of each fibre over the share of its length at one end, F unit vectors from origin to insertion:
/// (1/s) integral_0^s t ds, which is the chord over it. Zero for a fibre without length, and for one that is back
/// where it began.
Points end_tangents(const FibreSet& fibres, FibreEnd end, double share);

/// Line of action at one end (Lee et al. 2014, methods.md 7): the first principal axis of the fibres' ends there
/// where they lie on a line (PennationOptions), turned from origin to insertion; else the mean of the end tangents.
/// r^2 = 1 - (squared distances to the axis) / (squared distances to the mean).
LineOfAction line_of_action(const FibreSet& fibres, FibreEnd end, const PennationOptions& options = {});

/// From the mean of the origins to the mean of the insertions: the muscle as one straight line.
LineOfAction muscle_line(const FibreSet& fibres);

/// Angle of each fibre's end tangent to the line of action at that end, F values in [0, pi], 0 for fibres along
/// it; NaN for a fibre without a tangent. Squeezing or turning the muscle changes the line too.
struct Pennation {
    LineOfAction origin_line, insertion_line;
    std::vector<double> origin_rad, insertion_rad;
};
Pennation fibre_pennation(const FibreSet& fibres, const PennationOptions& options = {});

/// Mean of all angles of both ends, of those that are defined; NaN when none is.
double mean_pennation_rad(const Pennation& pennation);

/// Physiological cross-section in cm2 (Ravichandiran et al. 2009): V cos(mean pennation) / mean length.
/// volume and mean_length in scene units (cubed), unit_mm: millimetres in one. NaN when the length is not positive.
double pcsa_cm2(double volume, double mean_pennation_rad, double mean_length, double unit_mm);

/// Radius of each fibre as a cylinder, F values in scene units: half the mean distance of its points to the
/// nearest other fibre (Ravichandiran et al. 2009). NaN when there is no other fibre. Same bits for any threads.
std::vector<double> fibre_radii(const FibreSet& fibres, int threads = 1);

/// sum_f pi r_f^2 L_f / V in percent: about 79 for fibres on a square lattice, 91 on a triangular one; overlaps
/// count twice, so above 100 is possible. volume in cubed scene units; NaN when it is not positive, or F < 2.
double fibre_cover_percent(const FibreSet& fibres, double volume, int threads = 1);

/// All of it for one pose; NaN in what is not defined, everything NaN without fibres.
struct MuscleArchitecture {
    double length_mean_mm = 0, length_min_mm = 0, length_max_mm = 0;
    double pennation_origin_deg = 0, pennation_insertion_deg = 0; ///< means over the fibres
    double pennation_mean_deg = 0;                                ///< over both ends
    double pcsa_cm2 = 0;
    double cover_percent = 0;
    LineOfAction line;
};
/// volume: of the muscle in the same pose, in cubed scene units. Error as check_fibres, naming `muscle`.
MuscleArchitecture muscle_architecture(const FibreSet& fibres, double volume, double unit_mm,
                                       const std::string& muscle, int threads = 1,
                                       const PennationOptions& options = {});

} // namespace fascicle
