#pragma once
// Line muscles of a scene in one frame: where they run, how long they are, their moment arms about the scene's joint.

#include "fascicle/scene/line_muscles.hpp"
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

    /// Whether moment arms are known in one frame: every bone that carries a line turns about the hinge with the angle or stays
    /// (sampled at 25 frames). The arm is then
    ///   r = sign * sum over segments of t . (v(start) - v(end)), v(x) = a x (x - c) on bones that turn, 0 on others:
    /// the pull of the line about the axis a through c, exact for any path of least length.
    bool exact() const { return exact_; }

    /// Where the bones are (one pose per bone of the scene) and the joint's angle: what follows is about this frame.
    void set_frame(std::span<const Pose> bone_poses, double angle_rad);
    /// The frame of a run; null: rest.
    void set_frame(const Frame* frame);
    LineState measure(std::size_t m, bool with_polyline = false);

private:
    void find_turning_bodies(const Scene& scene);

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
    std::size_t bones_ = 0;
    std::vector<double> values_;
    Posture posture_; ///< poses: in the scene's axes, metres
};

} // namespace fascicle
