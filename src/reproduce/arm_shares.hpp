#pragma once
// Moment arms of fibres and lines against published bands.

#include "reproduce/results.hpp"

namespace fascicle::reproduce {

/// Poses: angle in degrees (ascending; on a way out from 0), and places of the frames in the run.
struct WayOut {
    std::vector<double> flexion_deg;
    std::vector<std::size_t> places;
};
/// Frames up to the first of the greatest angle; flexion is the angle's size. Empty when the angle does not change.
WayOut way_out(const RunData& run);

/// Poses that an experiment's arms are taken at: the way out; of a sweep from one side to the other, by ascending angle, without the way to
/// where it begins, and the angle is the joint's coordinate.
WayOut arm_poses(const Experiment& experiment, const RunData& run);

/// Over the fibres (or lines) of a run in each of the poses, mm; NaN where none is finite.
std::vector<Span3> arm_spans(const LineNumbers& lines, const WayOut& poses);
/// The means of these.
std::vector<double> mean_arms(const LineNumbers& lines, const WayOut& poses);

/// Fills result.arms: a row for every method with fibres, and for each of the line muscles that belong to the muscle.
void measure_arms(ExperimentResult& result);

/// Which line muscles of the model belong to a muscle ("glut_max1_r" to "gluteus_maximus"): their columns in lines.
std::vector<std::size_t> lines_of(const std::string& muscle, const LineNumbers& lines);

} // namespace fascicle::reproduce
