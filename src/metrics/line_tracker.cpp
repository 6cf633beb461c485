#include "fascicle/metrics/line_tracker.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/metrics/moment_arm.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fascicle {

namespace {

const LineMuscles& lines_of(const Scene& scene) {
    FASCICLE_ASSERT(scene.line_muscles != nullptr);
    return *scene.line_muscles;
}

constexpr double same_turn = 1e-6; ///< of rotation matrices, and of places against the scene's size

/// Whether the timeline turns the bone about the hinge by its angle from frame 0, in up to 25 frames.
bool turns_with_hinge(const Scene& scene, int bone, const Hinge& hinge) {
    const Timeline& timeline = scene.timeline;
    constexpr int samples = 25;
    const double first = timeline.angle_rad(0);
    for (int k = 0; k < samples; ++k) {
        const double frame = double(timeline.last_frame) * k / (samples - 1);
        const Pose wanted = rotation_about(hinge.centre, hinge.axis, timeline.angle_rad(frame) - first);
        const Pose pose = timeline.bone_pose(bone, frame);
        if (!((pose.rotation - wanted.rotation).norm() < same_turn) ||
            !((pose.apply(hinge.centre) - hinge.centre).norm() < same_turn * (1 + hinge.centre.norm())))
            return false;
    }
    return true;
}

} // namespace

LineTracker::LineTracker(const Scene& scene)
    : lines_((lines_of(scene), scene.line_muscles)), solver_(*lines_->model),
      units_(scene_units_per_metre(scene.unit)), sign_(flexion_sign(scene)),
      first_angle_(scene.timeline.angle_rad(0)), coordinate_(hinge_coordinate(*lines_, scene)),
      bones_(scene.bones.size()) {
    for (const std::string& bone : lines_->bone_of_body)
        bone_of_.push_back(bone.empty() ? -1 : scene.bone_index(bone));
    if (model_motion_in_force(scene) != nullptr && scene.model_motion->model == lines_->model) {
        trial_ = scene.model_motion;
        for (const int c : trial_->moving)
            if (lines_->model->skeleton.coordinates[static_cast<std::size_t>(c)].kind ==
                CoordinateKind::rotational)
                turning_.push_back(c);
        exact_ = trial_->coordinate >= 0;
    } else {
        find_turning_bodies(scene);
    }
    set_frame(nullptr);
}

bool LineTracker::has_bones(std::size_t m) const {
    const std::vector<PathPoint>& points = lines_->model->muscles[m].points;
    return trial_ == nullptr || std::all_of(points.begin(), points.end(), [&](const PathPoint& point) {
               return bone_of_[static_cast<std::size_t>(point.body)] >= 0;
           });
}

void LineTracker::find_turning_bodies(const Scene& scene) {
    const std::optional<Hinge>& hinge = scene.timeline.hinge;
    twists_.assign(bone_of_.size(), Twist{});
    rates_.assign(lines_->rest_values.size(), 0.0);
    exact_ = hinge.has_value() && hinge->axis.norm() > 0;
    if (!exact_)
        return;
    const std::vector<char> used = bodies_in_use(*lines_->model);
    const Vec3 axis = hinge->axis.normalized();
    for (std::size_t b = 0; b < bone_of_.size(); ++b) {
        const auto bone = static_cast<std::size_t>(bone_of_[b]);
        if (bone_of_[b] < 0 || bone >= scene.timeline.bone_tracks.size() ||
            !scene.timeline.bone_tracks[bone].moves())
            continue;
        twists_[b] = {axis, -axis.cross(hinge->centre / units_)};
        exact_ = exact_ && (used[b] == 0 || turns_with_hinge(scene, bone_of_[b], *hinge));
    }
    if (coordinate_.index >= 0) {
        std::vector<double> rates;
        coordinate_rates(lines_->model->skeleton, lines_->rest_values, coordinate_.index, rates);
        for (std::size_t c = 0; c < rates.size(); ++c)
            rates_[c] = coordinate_.per_angle * rates[c];
    }
}

void LineTracker::set_trial_frame(int frame) {
    posture_.q.assign(trial_->at(frame).begin(), trial_->at(frame).end());
    std::vector<Pose> poses;
    place_bodies(lines_->model->skeleton, posture_.q, poses);
    posture_.poses.resize(poses.size());
    for (std::size_t b = 0; b < poses.size(); ++b)
        posture_.poses[b] = trial_->body_pose(b, frame, poses);
}

void LineTracker::set_frame(std::span<const Pose> bone_poses, double angle_rad, int frame) {
    FASCICLE_ASSERT(bone_poses.size() == bones_);
    if (trial_ != nullptr && frame >= 0 && frame < trial_->frame_count())
        return set_trial_frame(frame);
    values_ = lines_->rest_values;
    if (coordinate_.index >= 0)
        values_[static_cast<std::size_t>(coordinate_.index)] +=
            coordinate_.per_angle * (angle_rad - first_angle_);
    posture_.q = values_;
    apply_couplers(lines_->model->skeleton, posture_.q);
    posture_.poses = lines_->rest;
    for (std::size_t b = 0; b < bone_of_.size(); ++b)
        if (bone_of_[b] >= 0) {
            Pose moved = bone_poses[static_cast<std::size_t>(bone_of_[b])];
            moved.translation /= units_;
            posture_.poses[b] = moved.after(lines_->rest[b]);
        }
}

void LineTracker::set_frame(const Frame* frame) {
    if (frame != nullptr)
        set_frame(frame->bone_poses, frame->angle_rad, frame->index);
    else
        set_frame(std::vector<Pose>(bones_), first_angle_, 0);
}

/// Of the path that was solved last. The twists are those of the model in its ground, turned into the scene's axes.
double LineTracker::model_arm(int coordinate) {
    const Skeleton& skeleton = lines_->model->skeleton;
    std::vector<double> rates;
    std::vector<Twist> twists;
    std::vector<Pose> poses;
    place_bodies(skeleton, posture_.q, poses);
    coordinate_rates(skeleton, posture_.q, coordinate, rates);
    body_twists(skeleton, posture_.q, rates, poses, twists);
    for (Twist& twist : twists) {
        twist.angular = trial_->ground.rotation * twist.angular;
        twist.linear =
            trial_->ground.rotation * twist.linear - twist.angular.cross(trial_->ground.translation);
    }
    return solver_.moment_arm(twists, rates, posture_);
}

double LineTracker::moment_arm_about(std::size_t m, int coordinate) {
    FASCICLE_ASSERT(trial_ != nullptr);
    solver_.solve(static_cast<int>(m), posture_);
    return units_ * model_arm(coordinate);
}

LineState LineTracker::measure(std::size_t m, bool with_polyline) {
    LineState state;
    state.length = units_ * solver_.solve(static_cast<int>(m), posture_).length;
    state.moment_arm = trial_ != nullptr && exact_ ? units_ * model_arm(trial_->coordinate)
                       : exact_ ? sign_ * units_ * solver_.moment_arm(twists_, rates_, posture_)
                                : std::numeric_limits<double>::quiet_NaN();
    if (with_polyline) {
        solver_.draw(posture_, state.polyline);
        for (Vec3& p : state.polyline)
            p *= units_;
    }
    return state;
}

} // namespace fascicle
