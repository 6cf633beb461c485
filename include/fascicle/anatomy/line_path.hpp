#pragma once
// The path of a line muscle at one posture: where it runs, how long it is, its moment arms.

#include "fascicle/anatomy/line_model.hpp"

namespace fascicle {

/// A posture: coordinates (couplers applied) and where the bodies are then, in ground.
struct Posture {
    std::vector<double> q;
    std::vector<Pose> poses;
};

/// Sets the posture for coordinate values; couplers are applied to them. No allocation once it has its size.
void set_posture(const Skeleton& skeleton, std::span<const double> values, Posture& posture);

/// A bend of the path, in ground, metres.
struct PathNode {
    Vec3 position = Vec3::Zero();
    int body = 0;              ///< that it goes with
    int point = -1;            ///< index into LineMuscle::points; -1: a tangent point of a wrap
    int wrap = -1;             ///< index into LineMuscle::wraps; -1: a path point
    double surface_length = 0; ///< second tangent point: length of the path from the first one to it
};

struct LinePath {
    std::vector<PathNode> nodes; ///< first tangent point of a wrap and second follow each other
    double length = 0;           ///< metres
};

/// Which points of a muscle are there: one flag per point, 1 for all but conditional ones out of range.
std::vector<char> active_points(const LineMuscle& muscle, std::span<const double> q);

/// Solves paths and keeps the memory for it: after a first round no allocation. One per thread.
class LinePathSolver {
public:
    explicit LinePathSolver(const LineModel& model) : model_(model) {}

    /// Path of a muscle. active: which points are there, of active_points; empty: those of the posture. Holding them still
    /// makes the length a smooth function near a posture where a conditional point comes or goes.
    ///
    /// Wraps are taken one after the other, each over the path that the others have left: it goes to the first segment that
    /// passes through the surface, else to the one that it lengthens least; then round again until the length stays within
    /// 1e-12 m, 60 rounds at most (OpenSim: 0.5 mm, 8 rounds). Where the first object passes the path by and the second one
    /// has an end of it inside, the two change places once.
    const LinePath& solve(int muscle, const Posture& posture, std::span<const char> active = {});

    /// Moment arm, metres, about a rotational coordinate (for a translational one: metres per metre):
    ///   r = -dL/dq = sum over segments of t . (v(start) - v(end)),
    /// t: unit vector along the segment; v: velocities of its ends per unit of the coordinate's rate, other coordinates
    /// still, coupled ones moving along. Positive: the muscle's pull drives the coordinate up.
    /// Exact for any path of least length: tangent points slide without changing it, so they count as fixed to the wrap
    /// object's body. Points that are there stay there. Of solve's last path; posture must be the same.
    double moment_arm(int coordinate, const Posture& posture);
    /// The same for any motion of the bodies, one twist each; rates: of the coordinates, for points that move with them.
    double moment_arm(std::span<const Twist> twists, std::span<const double> rates, const Posture& posture);

    /// The same by a central difference, -(L(q + h) - L(q - h)) / 2h, active points held still. Error below 1e-7 m for
    /// h = 1e-4 and paths of less than a metre, where wraps neither begin nor end within h; the check of the above.
    /// coordinates coupled to it follow.
    double moment_arm_by_difference(int muscle, int coordinate, const Posture& posture, double step = 1e-4);

    /// Points of the last path for drawing, in ground: nodes, and arcs over surfaces in small steps.
    void draw(const Posture& posture, Points& polyline);

private:
    void place_points(const Posture& posture, std::span<const char> active);
    void apply_wraps(const Posture& posture, std::span<const char> active);
    WrapOutcome apply_wrap(int wrap, const Posture& posture, std::span<const char> active);
    void remove_wrap(int wrap);
    double path_length() const;

    const LineModel& model_;
    const LineMuscle* muscle_ = nullptr;
    LinePath path_;
    std::vector<int> order_;
    std::vector<char> active_;
    std::vector<double> rates_;
    std::vector<Twist> twists_;
    std::vector<Vec3> curve_;
    Posture nearby_;
};

/// r = sum over segments of t . (v(start) - v(end)) for any polyline whose points go with bodies (see
/// LinePathSolver::moment_arm). body_of: one body per point.
double polyline_moment_arm(const Points& points, std::span<const int> body_of, std::span<const Twist> twists);

} // namespace fascicle
