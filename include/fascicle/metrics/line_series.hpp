#pragma once
// Lengths and moment arms of a scene's line muscles over the frames of a run, or of the motion that is planned.

#include "fascicle/scene/recording.hpp"

namespace fascicle {

/// K frames of M line muscles, millimetres, frame-major.
struct LineSeries {
    std::vector<std::string> muscles;               ///< M names, of the model
    std::vector<int> frames;                        ///< K
    std::vector<double> angles_rad;                 ///< K, as in metrics.csv
    std::vector<double> lengths_mm, moment_arms_mm; ///< K x M
    /// Where a trial of a model moves the scene: names of the coordinates that turn in it (C), and moment arms about each, K x M x C.
    std::vector<std::string> coordinates;
    std::vector<double> coordinate_arms_mm;
    bool exact_arms =
        true; ///< false: by tendon excursion (excursion_arms), NaN without an angle that changes

    double length_mm(std::size_t k, std::size_t m) const { return lengths_mm[k * muscles.size() + m]; }
    double moment_arm_mm(std::size_t k, std::size_t m) const {
        return moment_arms_mm[k * muscles.size() + m];
    }
};

/// Over the frames that a recording has. Empty for a scene without line muscles. Arms: LineTracker where they are exact, which
/// conditional points that come or go do not disturb, else by excursion.
LineSeries line_series(const Recording& recording);
/// Over frames 0 to timeline.last_frame of a scene: bones move as planned, whatever muscles do.
LineSeries line_series(const Scene& scene);

} // namespace fascicle
