#pragma once
// Line muscles of a scene in one frame: where they run, how long they are, their moment arms about the scene's joint.

#include "fascicle/scene/line_muscles.hpp"
#include "fascicle/scene/model_motion.hpp"
#include "fascicle/scene/recording.hpp"

namespace fascicle {

/// Scene units. moment_arm: r = -dL / d(sign * angle), sign = flexion_sign of the timeline, as of fibres: positive for what
/// shortens while the motion goes out. NaN where it isn't known in one frame (LineTracker::exact).
struct LineState {
    double length = 0;
    double moment_arm = 0;
    Points polyline; ///< along the path, arcs over wrap objects in small steps; empty when not asked for
};

/// Keeps solvers and memory; one per thread. Needs scene.line_muscles (FASCICLE_ASSERT), of which it keeps a share.
class LineTracker {
public:
    explicit LineTracker(const Scene& scene);

    std::size_t muscle_count() const { return lines_->model->muscles.size(); }
    const std::string& muscle_name(std::size_t m) const { return lines_->model->muscles[m].name; }

    /// Whether the muscle is worth drawing: with a trial of the model, whether all of its bodies have a bone.
    bool has_bones(std::size_t m) const;

    /// Whether moment arms are known in one frame: every bone that carries a line turns about the hinge with the angle or stays
    /// (sampled at 25 frames). The arm is then
    ///   r = sign * sum over segments of t . (v(start) - v(end)), v(x) = a x (x - c) on bones that turn, 0 on others:
    /// the pull of the line about the axis a through c, exact for any path of least length. With a trial of the model: about the
    /// coordinate that `angle_deg` is, r = -dL/dq, positive for what shortens as it rises; always exact.
    bool exact() const { return exact_; }

    /// Where the bones are (one pose per bone of the scene) and the joint's angle: what follows is about this frame. frame: its
    /// number, which tells all coordinates where a trial of the model moves the scene (model_motion.hpp); -1: not known.
    void set_frame(std::span<const Pose> bone_poses, double angle_rad, int frame = -1);
    /// The coordinates that change in the trial and turn something, by their numbers in the model; empty without a trial.
    const std::vector<int>& coordinates() const { return turning_; }
    /// Moment arm of a muscle about one of them in the frame, scene units: r = -dL/dq, other coordinates still but for coupled ones.
    double moment_arm_about(std::size_t m, int coordinate);

    /// The frame of a run; null: rest.
    void set_frame(const Frame* frame);
    LineState measure(std::size_t m, bool with_polyline = false);

private:
    void find_turning_bodies(const Scene& scene);
    void set_trial_frame(int frame);
    double model_arm(int coordinate);

    std::shared_ptr<const LineMuscles> lines_;
    LinePathSolver solver_;
    double units_; ///< in a metre
    double sign_ = 1;
    double first_angle_ = 0;
    LineCoordinate coordinate_;
    std::vector<int> bone_of_;  ///< per body, -1: stays
    std::vector<Twist> twists_; ///< per body, per radian of the scene's angle, metres
    std::vector<double> rates_; ///< of coordinates, likewise
    bool exact_ = false;
    std::shared_ptr<const ModelMotion> trial_; ///< in force, or null
    std::vector<int> turning_;
    std::size_t bones_ = 0;
    std::vector<double> values_;
    Posture posture_; ///< poses: in the scene's axes, metres
};

} // namespace fascicle
