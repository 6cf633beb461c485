#pragma once
// The fibres of a simulated run as muscles of an OpenSim model.

#include "fascicle/base/job_control.hpp"
#include "fascicle/geometry/axis_mapping.hpp"
#include "fascicle/scene/recording.hpp"

#include <filesystem>

namespace fascicle {

/// What the lengths and moment arms of the model are a function of.
enum class OsimCoordinate {
    automatic, ///< joint where the run has one that all moving bones follow, else time
    joint,     ///< the hinge's angle, positive in the direction of the motion's largest excursion
    time       ///< progress of the run from 0 to 1: any motion, every frame
};

struct OsimExportOptions {
    /// lps_to_opensim (X = -y, Y = z, Z = -x) or as_is. Both are rotations: nothing is mirrored.
    AxisMapping axes = AxisMapping::lps_to_opensim;
    OsimCoordinate coordinate = OsimCoordinate::automatic;
    double tolerance_mm = 1.0;    ///< of length, moment arm (mm per radian) and place of the points; > 0
    double specific_tension = 60; ///< N per cm2 of cross-section (Rajagopal et al. 2016)
    int threads = 1;
};

/// One fibre: what was written, and how far it is from the simulation. Largest absolute differences, millimetres; moment arms
/// millimetres per radian, NaN where the coordinate is time. Lengths, arms and points are those of the frames that the fibre was
/// fitted to, and half-way between them (against cubics through the four nearest frames).
struct OsimFibreReport {
    std::string muscle; ///< as in the scene
    int fibre = 0;      ///< fibre_id, from 0
    std::string name;   ///< in the model
    int points = 0, moving_points = 0;
    int knots = 0;                ///< of each spline; 0 without moving points
    double length_mm = 0;         ///< difference of the length, at frames
    double length_between_mm = 0; ///< ... between frames
    double moment_arm_mm =
        0; ///< of the arm by tendon excursion, from the lengths of model and run by the same excursion_arms
    double exact_moment_arm_mm =
        0; ///< of -dL/dq of the model against the run's by excursion, at frames and between
    double opensim_moment_arm_mm = 0; ///< ... of the arm that OpenSim's solver computes
    double point_mm = 0;              ///< of the inner points, at frames
    double length_other_frames_mm =
        0; ///< of the length, in frames that the fibre was not fitted to (the way back); NaN: none
};

struct OsimExportReport {
    std::filesystem::path model, motion, table, facts; ///< the files written: .osim, .mot, .csv, .json
    std::string coordinate;                            ///< its name in the model
    double range_min = 0, range_max = 0;               ///< radians, or progress
    int fitted_frames = 0, other_frames = 0;
    double bone_mm = 0; ///< largest distance of a bone's corners between model and run, all frames
    std::vector<OsimFibreReport> fibres;
    std::vector<std::string> notes;
    std::string summary; ///< one line

    /// Largest over the fibres; NaN when none has a number.
    double largest(double OsimFibreReport::*quantity) const;
};

/// Writes a model NAME.osim (version 40000, metres) and beside it NAME.mot, NAME_report.csv, NAME_report.json and Geometry/<bone>.vtp.
///
/// Bodies are the bones; their frames lie on ground's at rest, so that all numbers are the scene's, in metres and the wanted axes.
/// A hinge that all moving bones follow is a CustomJoint with one rotational coordinate, any other motion six splines of a
/// coordinate `progress`; bones that stay are welded to ground.
///
/// A fibre is a Millard2012EquilibriumMuscle. Its ends, and points that a bone carries, are PathPoints; a fibre that is straight
/// in all frames has no other points. The rest are MovingPathPoints with SimmSplines, as few knots as meet the tolerance. Of a
/// hinge's run the frames of the span with the largest excursion are fitted (the way out): on the way back a fibre has other
/// shapes, which a function of an angle cannot tell. The fit of the splines is by least squares; where there is a joint the
/// points are then moved by the least amount that makes the length follow a smooth target, which is near to the simulated
/// lengths and to the moment arms of fibres.csv (LengthTarget).
///
/// Neighbouring points, unless both are fixed, lie in frames of different bodies, and a point half-way is put in where their number is
/// odd: OpenSim's GeometryPath::addInEquivalentForces passes over segments within one body, although their length changes
/// where points move, so only then do its moment arms and joint moments belong to its lengths.
///
/// Force: specific tension times V / sum of fibre lengths, the same cross-section for each fibre (the sum is the PCSA of Ravichandiran et
/// al. 2009 with the pennation that the paths themselves have). Optimal fibre length: that at rest less 1 %, the tendon, which is
/// rigid: nothing is known of tendons here.
///
/// The report is measured on the text that was written, read back by read_osim and measured by LinePathSolver.
///
/// Error: no fibres in the run, nothing moves, coordinate joint without one, too many points for a model (35,000), a file that cannot be
/// written; an output would replace an input of the scene (usage). Cancelled. All files are there afterwards, or none is new.
OsimExportReport export_osim(const std::filesystem::path& model, const Recording& recording,
                             const OsimExportOptions& options = {}, const JobControl& control = {});

/// Why the recording cannot be written so, as the end of a sentence; empty when it can, as far as is seen without looking at all frames.
std::string reason_against_osim(const Recording& recording);

} // namespace fascicle
