#pragma once
// Numbers that others published, which curves are held against. Sources: ../shared/methods.md 8, as named at each.

#include "reproduce/experiment.hpp"
#include "reproduce/statistics.hpp"

#include <string>
#include <vector>

namespace fascicle::reproduce {

/// One frame of the published program (methods.md 8.2): 300 frames about the authors' own hinge centre.
struct PublishedFrame {
    double frame = 0; ///< of 300
    double volume_ratio = 0, edge_mean = 0, edge_p99 = 0;
    double dihedral_deg = 0;    ///< mean unsigned change
    double displacement_mm = 0; ///< mean; NaN: not measured
};
/// Empty for an unknown key.
const std::vector<PublishedFrame>& published_marks(const std::string& key);

/// Frames a second (methods.md 8.1): of the paper's table (i7-4930K, one thread), and of the public program on a 2-core Xeon, one thread.
struct PublishedSpeed {
    const char* object;
    int triangles;
    double frames_per_second, program_frames_per_second;
};
const std::vector<PublishedSpeed>& published_speeds();

/// Moment arms about hip flexion, mm, positive for a flexor: digitised lower and upper bounds over the angle in degrees (methods.md 8.5).
/// Empty for a muscle without.
const std::vector<BandPoint>& arm_band(const std::string& muscle);

/// A published model's least, greatest and mean arm, over fibres and poses, mm: over -10 to 60 degrees of flexion, -40 to 40 of adduction,
/// -30 to 30 of internal rotation, positive for what moves the thigh in this direction (methods.md 8.4, Modenese & Kohout 2020, Table 2).
struct PublishedArm {
    MotionKind motion;
    const char* muscle;
    const char* model;
    double least, greatest, mean;
};
const std::vector<PublishedArm>& published_arms();

/// Single measured arms over the angle, mm: Nemeth & Ohlsen 1985, Arnold et al. 2000 (methods.md 8.5).
struct MeasuredArms {
    const char* muscle;
    const char* source;
    std::vector<double> angle_deg, arm_mm;
};
const std::vector<MeasuredArms>& measured_arms();

/// Mean fibre length over that at 0 degrees, with the least and the greatest fibre, at angles of flexion (methods.md 8.5, 100 fibres).
struct PublishedRatio {
    const char* muscle;
    double angle_deg, mean, least, greatest;
};
const std::vector<PublishedRatio>& published_ratios();

/// Mean fibre length at 0 degrees and its standard deviation (methods.md 8.5, 100 fibres). Null for a muscle without.
struct PublishedRest {
    const char* muscle;
    double mean_mm, sd_mm;
};
const PublishedRest* published_rest(const std::string& muscle);

} // namespace fascicle::reproduce
