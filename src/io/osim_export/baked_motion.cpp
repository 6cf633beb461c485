#include "io/osim_export/baked_motion.hpp"

#include "fascicle/base/text.hpp"
#include "fascicle/metrics/moment_arm.hpp"
#include "fascicle/motion/joint_function.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace fascicle::io {
namespace {

constexpr double same_pose = 1e-7; ///< metres over a bone's size, and entries of the rotation

bool near(const Pose& a, const Pose& b) {
    return (a.rotation - b.rotation).cwiseAbs().maxCoeff() < same_pose &&
           (a.translation - b.translation).cwiseAbs().maxCoeff() < same_pose;
}

/// Poses of the bones in the model's axes: frames x bones.
std::vector<std::vector<Pose>> all_poses(const Recording& recording, const ToModel& to_model) {
    std::vector<std::vector<Pose>> poses;
    for (int k = 0; k < recording.frame_count(); ++k) {
        poses.emplace_back();
        for (const Pose& pose : recording.frame(k)->bone_poses)
            poses.back().push_back(to_model.pose(pose));
    }
    return poses;
}

/// A right-handed frame whose first axis is a.
Mat3 frame_along(const Vec3& a) {
    Eigen::Index least = 0;
    a.cwiseAbs().minCoeff(&least);
    Mat3 frame;
    frame.col(0) = a;
    frame.col(1) = Vec3::Unit(least).cross(a).normalized();
    frame.col(2) = a.cross(frame.col(1));
    return frame;
}

/// Body-fixed angles about x, y, z of R = Rx(a) Ry(b) Rz(c), near those before: each may go round any number of times.
Vec3 angles_xyz(const Mat3& r, const Vec3& before) {
    Vec3 angles(std::atan2(-r(1, 2), r(2, 2)), std::asin(std::clamp(r(0, 2), -1.0, 1.0)),
                std::atan2(-r(0, 1), r(0, 0)));
    for (Eigen::Index i = 0; i < 3; i += 2)
        angles[i] += 2 * std::numbers::pi * std::round((before[i] - angles[i]) / (2 * std::numbers::pi));
    return angles;
}

/// SimmSplines through the values at some of the places, as few as keep all within the tolerance; all of them where that is not enough.
/// channels: one list of values each, at all places.
std::vector<BakedFunction> spline_through(const std::vector<double>& places,
                                          const std::vector<std::vector<double>>& channels,
                                          double tolerance) {
    const std::size_t n = places.size();
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < std::min<std::size_t>(n, 4); ++i)
        chosen.push_back(n <= 4 ? i : i * (n - 1) / 3);
    std::vector<BakedFunction> functions(channels.size());
    for (;;) {
        std::vector<double> worst(chosen.size(), 0.0); // of each interval
        std::vector<std::size_t> worst_at(chosen.size(), 0);
        for (std::size_t c = 0; c < channels.size(); ++c) {
            BakedFunction& f = functions[c];
            f = {};
            for (const std::size_t i : chosen)
                f.x.push_back(places[i]), f.y.push_back(channels[c][i]);
            const JointFunction spline = JointFunction::simm_spline(f.x, f.y);
            std::size_t interval = 0;
            for (std::size_t i = 0; i < n; ++i) {
                while (interval + 2 < chosen.size() && i >= chosen[interval + 1])
                    ++interval;
                const double error = std::abs(spline.value(places[i]) - channels[c][i]);
                if (error > worst[interval])
                    worst[interval] = error, worst_at[interval] = i;
            }
        }
        std::vector<std::size_t> more;
        for (std::size_t i = 0; i < worst.size(); ++i)
            if (worst[i] > tolerance && !std::binary_search(chosen.begin(), chosen.end(), worst_at[i]))
                more.push_back(worst_at[i]);
        if (more.empty())
            break;
        chosen.insert(chosen.end(), more.begin(), more.end());
        std::sort(chosen.begin(), chosen.end());
    }
    for (std::size_t c = 0; c < channels.size(); ++c) { // what does not change is a constant
        const auto [least, most] = std::minmax_element(channels[c].begin(), channels[c].end());
        if (*most - *least <= tolerance)
            functions[c] = {{}, {channels[c].front()}};
    }
    return functions;
}

/// The joint of a bone that moves anyhow, as functions of the frames' values.
void free_joint(const std::vector<std::vector<Pose>>& poses, std::size_t bone, const Vec3& centre,
                const std::vector<double>& values, BakedJoint& joint) {
    joint.centre = centre;
    // The first axis is that of the largest turn, so that the second angle, which must stay below a quarter turn, is small.
    double largest = 0;
    Vec3 axis = Vec3::UnitX();
    for (const auto& frame : poses) {
        const Eigen::AngleAxisd turn(frame[bone].rotation);
        if (turn.angle() > largest + 1e-9)
            largest = turn.angle(), axis = turn.axis();
    }
    joint.axes = frame_along(axis);
    std::vector<std::vector<double>> channels(6);
    Vec3 before = Vec3::Zero();
    for (const auto& frame : poses) {
        before = angles_xyz(joint.axes.transpose() * frame[bone].rotation * joint.axes, before);
        const Vec3 shift = joint.axes.transpose() * (frame[bone].apply(centre) - centre);
        for (Eigen::Index i = 0; i < 3; ++i) {
            channels[static_cast<std::size_t>(i)].push_back(before[i]);
            channels[static_cast<std::size_t>(i) + 3].push_back(shift[i]);
        }
    }
    const std::vector<BakedFunction> functions = spline_through(values, channels, 1e-6);
    std::copy(functions.begin(), functions.end(), joint.functions.begin());
}

/// Ascending by value; of equal ones (to 1e-9 of the range) the first.
std::vector<int> by_value(std::vector<int> places, const std::vector<double>& values) {
    const auto value = [&](int k) { return values[static_cast<std::size_t>(k)]; };
    std::stable_sort(places.begin(), places.end(), [&](int a, int b) { return value(a) < value(b); });
    const double apart = places.empty() ? 0.0 : 1e-9 * (value(places.back()) - value(places.front()));
    std::vector<int> kept;
    for (const int k : places)
        if (kept.empty() || value(k) > value(kept.back()) + apart)
            kept.push_back(k);
    return kept;
}

/// The body that a hinge hangs on: the only bone that stays, or the one nearest to the hinge's centre; ground without any.
int parent_of_hinge(const Scene& scene, const std::vector<char>& moves, const Vec3& centre) {
    double nearest = std::numeric_limits<double>::infinity();
    int parent = 0;
    for (std::size_t b = 0; b < scene.bones.size(); ++b) {
        if (moves[b] != 0)
            continue;
        for (const Vec3& p : scene.bones[b].mesh->positions)
            if (const double d = (p - centre).squaredNorm(); d < nearest)
                nearest = d, parent = static_cast<int>(b) + 1;
    }
    return parent;
}

} // namespace

Pose BakedMotion::pose(int body, double value) const {
    return turns[static_cast<std::size_t>(body)] != 0 ? rotation_about(centre, axis, value) : Pose{};
}

BakedMotion bake_motion(const Recording& recording, const ToModel& to_model, OsimCoordinate wanted,
                        BakedModel& model) {
    const Scene& scene = recording.scene();
    const auto poses = all_poses(recording, to_model);
    const std::size_t frames = poses.size(), bones = scene.bones.size();
    std::vector<char> moves(bones, 0);
    for (const auto& frame : poses)
        for (std::size_t b = 0; b < bones; ++b)
            moves[b] = static_cast<char>(moves[b] != 0 || !near(frame[b], poses[0][b]));
    if (std::count(moves.begin(), moves.end(), 1) == 0)
        throw_error("OpenSim model", "no bone moves in this run", "a run with a motion, to be baked over it");

    BakedMotion motion;
    OsimNames names({"ground"}), joint_names, coordinate_names;
    model.bodies.push_back({"ground", -1, {}, 0, Vec3::Zero(), {}});
    for (std::size_t b = 0; b < bones; ++b) {
        BakedBody body;
        body.name = names.unique(osim_name(scene.bones[b].name, "bone"));
        body.bone = static_cast<int>(b);
        body.mesh_file = file_name_for(body.name) + ".vtp"; // names may be longer than those of files
        model.bodies.push_back(std::move(body));
    }
    for (std::size_t k = 0; k < frames; ++k)
        motion.angles_rad.push_back(recording.frame(static_cast<int>(k))->angle_rad);
    motion.sign = flexion_sign(scene);
    motion.turns.assign(bones + 1, 0);
    for (std::size_t k = 0; k < frames; ++k) {
        motion.poses.emplace_back(bones + 1);
        for (std::size_t b = 0; b < bones; ++b)
            if (moves[b] != 0)
                motion.poses.back()[b + 1] = poses[k][b];
    }
    for (std::size_t b = 0; b < bones; ++b)
        motion.placed.push_back(moves[b] != 0 ? Pose{} : poses[0][b]);

    // Do all moving bones follow the hinge in every frame?
    bool hinge = scene.timeline.hinge.has_value();
    if (hinge) {
        motion.centre = to_model.point(scene.timeline.hinge->centre);
        motion.axis = motion.sign * (to_model.turn * scene.timeline.hinge->axis.normalized());
        for (std::size_t k = 0; hinge && k < frames; ++k) {
            const Pose turned =
                rotation_about(motion.centre, motion.axis, motion.sign * motion.angles_rad[k]);
            for (std::size_t b = 0; b < bones; ++b)
                hinge = hinge && near(poses[k][b], moves[b] != 0 ? turned : poses[0][b]);
        }
    }
    const std::vector<MotionSpan> spans = hinge ? motion_spans(motion.angles_rad) : std::vector<MotionSpan>{};
    hinge = hinge && !spans.empty();
    if (wanted == OsimCoordinate::joint && !hinge)
        throw_error("OpenSim model", "the moving bones do not all turn about one hinge",
                    "the coordinate time (or automatic)");
    hinge = hinge && wanted != OsimCoordinate::time;
    motion.kind = hinge ? OsimCoordinate::joint : OsimCoordinate::time;

    std::vector<int> fitted;
    if (hinge) {
        const auto excursion = [&](const MotionSpan& s) {
            return std::abs(motion.angles_rad[s.last] - motion.angles_rad[s.first]);
        };
        MotionSpan span = spans.front();
        for (const MotionSpan& s : spans)
            if (excursion(s) > excursion(span) * (1 + 1e-9))
                span = s;
        for (const double angle : motion.angles_rad)
            motion.values.push_back(motion.sign * angle + 0.0); // no -0
        motion.span_first = static_cast<int>(span.first);
        motion.span_last = static_cast<int>(span.last);
        for (std::size_t k = span.first; k <= span.last; ++k)
            fitted.push_back(static_cast<int>(k));
    } else {
        const int first = recording.frame(0)->index, last = recording.last_frame()->index;
        for (std::size_t k = 0; k < frames; ++k) {
            const int index = recording.frame(static_cast<int>(k))->index;
            motion.values.push_back(double(index - first) / std::max(1, last - first));
            fitted.push_back(static_cast<int>(k));
        }
    }
    motion.fitted = by_value(std::move(fitted), motion.values);

    const auto [least, most] = std::minmax_element(motion.values.begin(), motion.values.end());
    int first_moving = -1;
    for (std::size_t b = 0; b < bones; ++b) {
        BakedJoint joint;
        joint.name = joint_names.unique(model.bodies[b + 1].name + "_joint");
        joint.child = static_cast<int>(b) + 1;
        if (moves[b] != 0 && hinge)
            motion.turns[b + 1] = 1;
        if (moves[b] != 0 && hinge && first_moving >= 0) {
            joint.parent = first_moving; // moves alike
        } else if (moves[b] != 0) {
            BakedCoordinate coordinate;
            coordinate.joint = joint.name;
            coordinate.rotational = hinge;
            coordinate.name =
                coordinate_names.unique(hinge              ? model.bodies[b + 1].name + "_angle"
                                        : first_moving < 0 ? "progress"
                                                           : "progress_" + model.bodies[b + 1].name);
            coordinate.default_value = motion.values.front();
            coordinate.range_min = *least;
            coordinate.range_max = *most;
            joint.coordinate = static_cast<int>(model.coordinates.size());
            joint.hinge = hinge;
            if (hinge) {
                joint.parent = parent_of_hinge(scene, moves, scene.timeline.hinge->centre);
                joint.centre = motion.centre;
                joint.axes = frame_along(motion.axis);
            } else {
                const Points& mesh = scene.bones[b].mesh->positions;
                const Vec3 middle =
                    std::accumulate(mesh.begin(), mesh.end(), Vec3(Vec3::Zero())) / double(mesh.size());
                free_joint(poses, b, to_model.point(middle), motion.values, joint);
            }
            model.coordinates.push_back(std::move(coordinate));
            if (first_moving < 0)
                first_moving = joint.child;
        }
        model.joints.push_back(std::move(joint));
    }
    return motion;
}

} // namespace fascicle::io
