#pragma once
// How far a written model is from the run, measured on the model as it is read back.

#include "fascicle/anatomy/line_path.hpp"
#include "io/osim_export/fibre_courses.hpp"

namespace fascicle::io {

/// Measures one fibre after the other; the model's coordinates are all given the value of the first.
class BakeReport {
public:
    /// Error when the model has no coordinate. All outlive this.
    BakeReport(const LineModel& model, const BakedMotion& motion);

    /// muscle: index in the model. simulated: of FibrePath. Fills the differences; may run on several threads.
    void measure(int muscle, const FibreCourse& course, const std::vector<int>& simulated,
                 OsimFibreReport& report) const;

    /// Largest distance, millimetres, between where a bone's corners are in the model and in the run, over all frames.
    double bone_mm(const std::vector<Points>& corners_of_body, const BakedModel& written) const;

private:
    const LineModel& model_;
    const BakedMotion& motion_;
    std::vector<double> places_;    ///< fitted frames, and half-way between them: 2 K - 1
    std::vector<Posture> postures_; ///< at places_
    std::vector<int> other_frames_; ///< places in the recording that are not fitted
    std::vector<Posture> other_postures_;
};

/// The arm that OpenSim's MomentArmSolver would compute, as GeometryPath::addInEquivalentForces has it: unit tension on the ends of those
/// segments alone that go from one body to another, moving points with their own rate. Metres. Model without wraps or couplers to what the
/// muscle crosses. posture: of LineModel's skeleton.
double opensim_moment_arm(const LineModel& model, int muscle, int coordinate, const Posture& posture);

} // namespace fascicle::io
