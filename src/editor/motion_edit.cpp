#include "editor/motion_edit.hpp"

#include "editor/commands.hpp"
#include "editor/frame_axis.hpp"
#include "editor/picking.hpp"
#include "editor/scene_view.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/io/table_motion.hpp"

#include <algorithm>
#include <chrono>
#include <numbers>

namespace fascicle::editor {

namespace {

/// Errors go to the log, the document stays as it was.
template <class F>
bool attempt(EditorContext& context, F change) {
    try {
        change();
        return true;
    } catch (const std::exception& error) {
        context.document.discard_edits();
        context.log.add(Severity::error, error.what());
        return false;
    }
}

} // namespace

std::vector<AnatomicalAxis> anatomical_axes(view::WorldAxes axes) {
    const view::AnatomicalFrame f = view::anatomical_frame(axes);
    return {{"Flexion", -f.left},
            {"Abduction, right", -f.anterior},
            {"Abduction, left", f.anterior},
            {"Internal rotation, right", f.superior},
            {"Internal rotation, left", -f.superior}};
}

MotionEdit::~MotionEdit() = default; // futures wait for their threads

void MotionEdit::edit(EditorContext& context, const actions::HingeMotion& motion) {
    if (attempt(context, [&] { actions::edit_hinge(context.document, motion); }))
        edited_ = context.document.version();
}

void MotionEdit::edit_key(EditorContext& context, int bone, std::size_t index, const actions::Screw& screw) {
    if (attempt(context, [&] {
            const Pose pose = actions::pose_of(screw);
            actions::edit_pose_key(context.document, bone, index, pose);
            edited_key_ = {bone, index, pose, screw};
        }))
        edited_ = context.document.version();
}

actions::Screw MotionEdit::key_screw(int bone, std::size_t index, const Pose& pose, const Vec3& near) const {
    const EditedKey& last = edited_key_;
    if (last.bone == bone && last.index == index && last.pose.rotation == pose.rotation &&
        last.pose.translation == pose.translation)
        return last.screw;
    return actions::screw_of(pose, near);
}

void MotionEdit::commit(EditorContext& context, const std::string& name) {
    if (context.document.has_uncommitted_edits())
        actions::commit_motion(context.document, name);
}

void MotionEdit::set(EditorContext& context, const actions::HingeMotion& motion, const char* name) {
    edit(context, motion);
    commit(context, name);
}

void MotionEdit::fit(EditorContext& context) {
    if (!hinge_ || hinge_->moving.empty())
        return;
    if (fit_.valid())
        given_up_.push_back(std::move(fit_));
    fit_problem_.clear();
    ball_.reset();
    fit_ = std::async(std::launch::async, [head = context.document.head(), moving = hinge_->moving] {
        FitResult result;
        result.moving = moving;
        std::vector<MeshPtr> fixed;
        for (int b = 0; b < static_cast<int>(head->bones.size()); ++b)
            if (std::count(moving.begin(), moving.end(), b) == 0)
                fixed.push_back(head->bones[static_cast<std::size_t>(b)].mesh);
        result.problem = "no bone stays at rest";
        for (const int b : fixed.empty() ? std::vector<int>{} : moving) {
            const Bone& bone = head->bones[static_cast<std::size_t>(b)];
            const JointFit fit = fit_joint_centre(*bone.mesh, fixed);
            if (!fit.sphere)
                result.problem = bone.name + ": " + fit.reason;
            else if (!result.ball || fit.coverage > result.ball->coverage)
                result.ball = FittedBall{*fit.sphere, fit.rms, fit.coverage,
                                         fit.ball_on_moving_bone ? bone.name : "the socket of " + bone.name};
        }
        return result;
    });
}

void MotionEdit::finish_fit() {
    if (fit_.valid())
        fit_.wait();
}

void MotionEdit::take_fit(EditorContext& context) {
    const auto finished = [](const std::future<FitResult>& f) {
        return f.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
    };
    std::erase_if(given_up_, finished);
    if (!fit_.valid() || !finished(fit_) || context.document.has_uncommitted_edits())
        return;
    const FitResult result = fit_.get();
    if (!hinge_ || hinge_->moving != result.moving)
        return; // another question by now
    if (!result.ball) {
        fit_problem_ = result.problem;
        context.log.add(Severity::warning, "No joint centre can be fitted (" + result.problem + ")");
        return;
    }
    ball_ = result.ball;
    actions::HingeMotion motion = *hinge_;
    motion.hinge.centre = ball_->sphere.centre;
    set(context, motion, "Fit joint centre");
}

void MotionEdit::pick(EditorContext& context, PickFor what) {
    pick_ = what;
    pressed_on_bone_ = false;
    first_point_.reset();
    context.state.tool = what == PickFor::nothing ? Tool::look : Tool::pick_point;
}

void MotionEdit::show_table(EditorContext& context, std::shared_ptr<const StorageTable> read) {
    table = std::move(read);
    table_problem.clear();
    degrees = table->in_degrees;
    frames_per_second = 1 / frame_seconds(context.document.scene());
    // The column whose name speaks of what the hip does, else the first that changes.
    column = -1;
    for (int c = 0; c < static_cast<int>(table->columns.size()); ++c) {
        const std::string& name = table->columns[static_cast<std::size_t>(c)];
        if (name == "time")
            continue;
        bool changes = false;
        for (std::size_t r = 1; r < table->row_count() && !changes; ++r)
            changes =
                table->value(r, static_cast<std::size_t>(c)) != table->value(0, static_cast<std::size_t>(c));
        if (changes && name.find("flexion") != std::string::npos) {
            column = c;
            break;
        }
        if (changes && column < 0)
            column = c;
    }
    // A column of flexion counts forward, the hinge perhaps not.
    const Vec3 flexion = anatomical_axes(context.state.camera.axes()).front().axis;
    const bool names_flexion =
        column >= 0 && table->columns[static_cast<std::size_t>(column)].find("flexion") != std::string::npos;
    reversed = names_flexion && hinge_ && hinge_->hinge.axis.normalized().dot(flexion) < -0.8;
    for (const std::string& note : table->notes)
        context.log.add(Severity::note, note);
    way = MotionWay::file;
    run_command(context, Command::show_motion);
}

void MotionEdit::apply_column(EditorContext& context) {
    table_problem.clear();
    try {
        if (!hinge_)
            throw_error(table->file, "the scene has no hinge yet",
                        "one under Hinge: which bones turn, and where");
        const TableTiming timing{1 / frames_per_second, from_rest ? 0 : lead_in};
        const double factor = (degrees ? std::numbers::pi / 180 : 1.0) * (reversed ? -1 : 1);
        actions::set_hinge_angles(context.document, hinge_->hinge,
                                  column_angles(*table, column, factor, timing), hinge_->moving,
                                  "Set motion from " + table->columns[static_cast<std::size_t>(column)]);
    } catch (const std::exception& error) {
        table_problem = error.what();
        context.log.add(Severity::error, table_problem);
    }
}

void MotionEdit::apply_model(EditorContext& context) {
    table_problem.clear();
    try {
        const Scene& scene = context.document.scene();
        FASCICLE_ASSERT(scene.line_muscles != nullptr);
        // What stays: the first body whose bone has no motion now, else the first with a bone.
        int fixed = -1;
        for (int b = 0; b < static_cast<int>(bone_of_body.size()); ++b) {
            const int bone = scene.bone_index(bone_of_body[static_cast<std::size_t>(b)]);
            if (bone < 0)
                continue;
            const bool still = !actions::bone_moves(scene, bone);
            if (fixed < 0 ||
                (still &&
                 actions::bone_moves(scene, scene.bone_index(bone_of_body[static_cast<std::size_t>(fixed)]))))
                fixed = b;
        }
        if (fixed < 0)
            throw_error(table->file, "no body of the model belongs to a bone", "bones chosen for bodies");
        const TableTiming timing{1 / frames_per_second, from_rest ? 0 : lead_in};
        std::vector<std::string> notes;
        Timeline timeline =
            model_timeline(*table, *scene.line_muscles, bone_of_body, fixed, scene, timing, notes);
        actions::set_timeline(context.document, std::move(timeline), {}, "Set motion of a model");
        for (const std::string& note : notes)
            context.log.add(Severity::note, note);
    } catch (const std::exception& error) {
        table_problem = error.what();
        context.log.add(Severity::error, table_problem);
    }
}

/// Bones where the edited timeline has them, muscles at rest: at the playhead, or at the farthest turn when that is at rest.
void MotionEdit::make_preview(const EditorContext& context) {
    const Scene& scene = context.document.scene();
    int frame = context.playhead();
    if (frame == 0) {
        if (way == MotionWay::hinge && hinge_ && hinge_->there_and_back)
            frame = hinge_->phases.out;
        const int bone = scene.bone_index(key_bone);
        if (way == MotionWay::keys && bone >= 0 &&
            static_cast<std::size_t>(bone) < scene.timeline.bone_tracks.size()) {
            const auto& keys = scene.timeline.bone_tracks[static_cast<std::size_t>(bone)].keys;
            if (key >= 0 && key < static_cast<int>(keys.size()))
                frame = static_cast<int>(keys[static_cast<std::size_t>(key)].frame);
        }
    }
    if (preview_ && preview_version_ == version_ && preview_frame_ == frame)
        return;
    preview_version_ = version_;
    preview_frame_ = frame;
    auto shown = std::make_shared<Frame>();
    shown->index = frame;
    shown->angle_rad = scene.timeline.angle_rad(frame);
    for (std::size_t b = 0; b < scene.bones.size(); ++b)
        shown->bone_poses.push_back(scene.timeline.bone_pose(static_cast<int>(b), frame));
    for (const Muscle& muscle : scene.muscles)
        shown->muscle_positions.push_back(view::mesh_points(muscle.mesh));
    preview_ = view::subject_of(std::make_shared<const Scene>(scene));
    preview_->frame = std::move(shown);
}

void MotionEdit::update(EditorContext& context) {
    if (version_ != context.document.version()) {
        version_ = context.document.version();
        hinge_ = actions::hinge_motion(context.document.scene());
        const auto& lines = context.document.scene().line_muscles;
        if (lines == nullptr)
            bone_of_body.clear();
        else if (bone_of_body.size() != lines->bone_of_body.size())
            bone_of_body = lines->bone_of_body;
    }
    if (ball_ &&
        (!hinge_ || (hinge_->hinge.centre - ball_->sphere.centre).norm() > 1e-9 * ball_->sphere.radius))
        ball_.reset(); // the hinge is no longer where the ball is
    take_fit(context);
    if (context.state.tool != Tool::pick_point)
        pick_ = PickFor::nothing; // left by Esc
    if (context.document.has_uncommitted_edits() && edited_ == context.document.version())
        make_preview(context);
    else
        preview_.reset();
}

void MotionEdit::document_replaced(EditorContext& context) {
    if (fit_.valid())
        given_up_.push_back(std::move(fit_));
    ball_.reset();
    fit_problem_.clear();
    preview_.reset();
    table.reset();
    table_problem.clear();
    bone_of_body.clear();
    key_bone.clear();
    key = -1;
    version_ = 0;
    pick(context, PickFor::nothing);
}

std::optional<double> MotionEdit::redraw_after() const {
    return fit_.valid() || !given_up_.empty() ? std::optional<double>(1.0 / 25) : std::nullopt;
}

bool MotionEdit::take_pointer(EditorContext& context, const PointerInput& input, const view::ViewSize& size) {
    const auto bone_under = [&]() -> std::optional<Vec3> {
        const view::ViewSubject subject = view_subject(context);
        view::ViewOptions options = view_options(context, *subject.scene);
        options.hidden_muscles.assign(subject.scene->muscles.size(), true); // through the muscles
        const std::optional<Hit> hit =
            fascicle::editor::pick(subject, options, context.state.camera.ray(input.x, input.y, size));
        if (!hit)
            return std::nullopt;
        const auto bone = static_cast<std::size_t>(hit->bone);
        return subject.frame == nullptr ? hit->point
                                        : subject.frame->bone_poses[bone].apply_inverse(hit->point);
    };
    if (input.pressed == 0)
        pressed_on_bone_ = bone_under().has_value();
    if (input.released == 0 && pressed_on_bone_) {
        pressed_on_bone_ = false;
        if (const std::optional<Vec3> point = bone_under())
            take_point(context, *point);
        return true;
    }
    return pressed_on_bone_;
}

void MotionEdit::take_point(EditorContext& context, const Vec3& point) {
    if (pick_ == PickFor::key_point) {
        const int bone = context.document.scene().bone_index(key_bone);
        const auto& tracks = context.document.scene().timeline.bone_tracks;
        if (bone >= 0 && static_cast<std::size_t>(bone) < tracks.size() && key > 0 &&
            key < static_cast<int>(tracks[static_cast<std::size_t>(bone)].keys.size())) {
            const PoseKey& edited =
                tracks[static_cast<std::size_t>(bone)].keys[static_cast<std::size_t>(key)];
            actions::Screw screw = key_screw(bone, static_cast<std::size_t>(key), edited.pose, point);
            screw.centre = point;
            edit_key(context, bone, static_cast<std::size_t>(key), screw);
            commit(context, "Set key, " + key_bone);
        }
        return pick(context, PickFor::nothing);
    }
    if (!hinge_)
        return pick(context, PickFor::nothing);
    actions::HingeMotion motion = *hinge_;
    if (pick_ == PickFor::axis_first) {
        first_point_ = point;
        pick_ = PickFor::axis_second;
        return;
    }
    if (pick_ == PickFor::axis_second && first_point_) {
        if ((point - *first_point_).norm() > 0) {
            motion.hinge.centre = 0.5 * (*first_point_ + point);
            motion.hinge.axis = (point - *first_point_).normalized();
            set(context, motion, "Set joint axis");
        }
    } else if (pick_ == PickFor::centre) {
        motion.hinge.centre = point;
        set(context, motion, "Set joint centre");
    }
    pick(context, PickFor::nothing);
}

bool MotionEdit::cancel(EditorContext& context) {
    const bool something = pick_ != PickFor::nothing;
    pick(context, PickFor::nothing);
    return something;
}

} // namespace fascicle::editor
