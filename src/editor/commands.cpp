#include "editor/commands.hpp"

#include "editor/dialogs/mesh_dialog.hpp"
#include "editor/dialogs/picture_dialog.hpp"
#include "editor/fly_to_worst.hpp"
#include "fascicle/document/actions/scene_actions.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fascicle::editor {

namespace {

using view::StandardView;

constexpr double orbit_step = 15 * std::numbers::pi / 180;
constexpr float least_scale = 0.75f, most_scale = 3.0f, scale_step = 0.25f;

/// Number of a camera command, 0 to 3.
std::size_t slot(Command command, Command first) {
    return static_cast<std::size_t>(static_cast<int>(command) - static_cast<int>(first));
}

void add_object(const EditorContext& context, const Selection& object, BoundingBox& box) {
    const ShownFrame shown = context.shown();
    const Scene& scene = context.shown_scene();
    const FramePtr& frame = shown.frame;
    if (object.kind == Selection::Kind::bone) {
        const int i = scene.bone_index(object.name);
        if (i < 0)
            return;
        const auto index = static_cast<std::size_t>(i);
        const Pose pose = frame != nullptr ? frame->bone_poses[index] : Pose{};
        for (const Vec3& p : scene.bones[index].mesh->positions)
            box.add(pose.apply(p));
    } else if (object.kind == Selection::Kind::muscle) {
        const int i = scene.muscle_index(object.name);
        if (i < 0)
            return;
        const auto index = static_cast<std::size_t>(i);
        const Points& points =
            frame != nullptr ? *frame->muscle_positions[index] : scene.muscles[index].mesh->positions;
        for (const Vec3& p : points)
            if (p.allFinite())
                box.add(p);
    }
}

void hide_others(EditorContext& context) {
    EditorState& state = context.state;
    state.hidden.clear();
    const auto hide = [&](const std::string& name) {
        if (name != state.selection.name)
            state.hidden.insert(name);
    };
    for (const Bone& bone : context.document.scene().bones)
        hide(bone.name);
    for (const Muscle& muscle : context.document.scene().muscles)
        hide(muscle.name);
}

void remove_selected(EditorContext& context) {
    const Selection selection = context.state.selection;
    const Scene& scene = context.document.scene();
    if (selection.kind == Selection::Kind::bone)
        actions::remove_bone(context.document, scene.bone_index(selection.name));
    else
        actions::remove_muscle(context.document, scene.muscle_index(selection.name));
    context.state.selection = {};
}

bool selection_exists(const EditorContext& context) {
    const Selection& selection = context.state.selection;
    const Scene& scene = context.document.scene();
    return (selection.kind == Selection::Kind::bone && scene.bone_index(selection.name) >= 0) ||
           (selection.kind == Selection::Kind::muscle && scene.muscle_index(selection.name) >= 0);
}

void step(EditorContext& context, int frames) {
    context.state.playback.playing = false;
    context.move_playhead(context.playhead() + frames);
}

void play_pause(EditorContext& context) {
    Playback& playback = context.state.playback;
    playback.playing = !playback.playing;
    const bool at_end = context.playhead() >= context.runs.available_count() - 1;
    if (playback.playing && at_end && !context.runs.running())
        playback.position = 0;
}

/// Esc: the run first, then what is open, then the selection.
void escape(EditorContext& context) {
    EditorState& state = context.state;
    if (context.document.has_uncommitted_edits())
        context.document.discard_edits();
    else if (state.show_shortcuts)
        state.show_shortcuts = false;
    else if (context.runs.running())
        run_command(context, Command::cancel_run);
    else
        state.selection = {};
}

void look(EditorContext& context, StandardView standard) {
    context.state.camera.look_from(standard);
}

void set_scale(EditorContext& context, float scale) {
    context.state.scale = std::clamp(scale, least_scale, most_scale);
}

} // namespace

BoundingBox object_bounds(const EditorContext& context, const Selection& object) {
    BoundingBox box;
    add_object(context, object, box);
    return box;
}

BoundingBox scene_bounds(const EditorContext& context) {
    BoundingBox box;
    const Scene& scene = context.shown_scene();
    for (const Bone& bone : scene.bones)
        if (context.state.visible(bone.name))
            add_object(context, {Selection::Kind::bone, bone.name}, box);
    for (const Muscle& muscle : scene.muscles)
        if (context.state.visible(muscle.name))
            add_object(context, {Selection::Kind::muscle, muscle.name}, box);
    return box;
}

CommandState command_state(const EditorContext& context, Command command) {
    using C = Command;
    const EditorState& state = context.state;
    const auto only_if = [](bool enabled, const char* reason) {
        return CommandState{enabled, false, enabled ? "" : reason};
    };
    const auto checked = [](bool on) { return CommandState{true, on, {}}; };
    switch (command) {
    case C::undo:
        return only_if(context.document.has_uncommitted_edits() || context.document.history().can_undo(),
                       "nothing to take back");
    case C::redo:
        return only_if(context.document.history().can_redo(), "nothing to do again");
    case C::remove_selected:
    case C::frame_selection:
    case C::hide_selected:
    case C::hide_others:
        return only_if(selection_exists(context), "nothing is selected");
    case C::deselect:
        return only_if(state.selection.kind != Selection::Kind::none, "nothing is selected");
    case C::play_pause:
        return only_if(context.runs.available_count() > 0 || context.runs.running(), "no frames yet");
    case C::show_all:
        return only_if(!state.hidden.empty(), "everything is visible");
    case C::fly_to_worst:
        return only_if(!context.shown_scene().muscles.empty() && !context.shown_scene().bones.empty(),
                       "the scene needs a muscle and a bone");
    case C::run_again:
        return only_if(!context.document.scene().muscles.empty(), "the scene has no muscle");
    case C::cancel_run:
        return only_if(context.runs.running(), "nothing is being computed");
    case C::recall_camera_1:
    case C::recall_camera_2:
    case C::recall_camera_3:
    case C::recall_camera_4:
        return only_if(state.camera_slots[slot(command, C::recall_camera_1)].has_value(),
                       "no view kept there");
    case C::toggle_loop:
        return checked(state.playback.loop);
    case C::toggle_orthographic:
        return checked(state.camera.orthographic());
    case C::toggle_wireframe:
        return checked(state.wireframe);
    case C::toggle_attachments:
        return checked(state.attachments);
    case C::toggle_rest_ghost:
        return checked(state.rest_ghost);
    case C::toggle_joint_axis:
        return checked(state.joint_axis);
    case C::toggle_theme:
        return checked(!state.dark);
    case C::show_shortcuts:
        return checked(state.show_shortcuts);
    default:
        return {};
    }
}

void run_command(EditorContext& context, Command command) {
    using C = Command;
    if (!command_state(context, command).enabled)
        return;
    EditorState& state = context.state;
    switch (command) {
    case C::open_file:
        return context.mesh_dialog.open();
    case C::save_picture:
        state.wants_picture = next_picture_name(context.document.scene().name, context.playhead());
        return;
    case C::save_picture_as:
        return context.picture_dialog.open(
            next_picture_name(context.document.scene().name, context.playhead()));
    case C::quit:
        state.wants_quit = true;
        return;
    case C::undo:
        context.document.undo();
        return;
    case C::redo:
        context.document.redo();
        return;
    case C::remove_selected:
        return remove_selected(context);
    case C::deselect:
        state.selection = {};
        return;
    case C::play_pause:
        return play_pause(context);
    case C::step_back:
        return step(context, -1);
    case C::step_on:
        return step(context, 1);
    case C::step_back_10:
        return step(context, -10);
    case C::step_on_10:
        return step(context, 10);
    case C::first_frame:
        return step(context, -context.playhead());
    case C::last_frame:
        return step(context, context.runs.available_count() - 1 - context.playhead());
    case C::toggle_loop:
        state.playback.loop = !state.playback.loop;
        return;
    case C::run_again:
        return context.runs.restart();
    case C::cancel_run:
        context.runs.cancel();
        context.log.add(Severity::note, "Run stopped; the frames so far stay.");
        return;
    case C::frame_selection:
        return state.camera.frame(object_bounds(context, state.selection), state.view_aspect);
    case C::frame_all:
        return state.camera.frame(scene_bounds(context), state.view_aspect);
    case C::fly_to_worst:
        return fly_to_worst(context);
    case C::view_anterior:
        return look(context, StandardView::anterior);
    case C::view_posterior:
        return look(context, StandardView::posterior);
    case C::view_left:
        return look(context, StandardView::left);
    case C::view_right:
        return look(context, StandardView::right);
    case C::view_superior:
        return look(context, StandardView::superior);
    case C::view_inferior:
        return look(context, StandardView::inferior);
    case C::orbit_left:
        return state.camera.orbit_by(-orbit_step, 0);
    case C::orbit_right:
        return state.camera.orbit_by(orbit_step, 0);
    case C::orbit_up:
        return state.camera.orbit_by(0, orbit_step);
    case C::orbit_down:
        return state.camera.orbit_by(0, -orbit_step);
    case C::toggle_orthographic:
        return state.camera.set_orthographic(!state.camera.orthographic());
    case C::store_camera_1:
    case C::store_camera_2:
    case C::store_camera_3:
    case C::store_camera_4:
        state.camera_slots[slot(command, C::store_camera_1)] = state.camera;
        return;
    case C::recall_camera_1:
    case C::recall_camera_2:
    case C::recall_camera_3:
    case C::recall_camera_4:
        state.camera = *state.camera_slots[slot(command, C::recall_camera_1)];
        return;
    case C::hide_selected:
        state.hidden.insert(state.selection.name);
        return;
    case C::hide_others:
        return hide_others(context);
    case C::show_all:
        state.hidden.clear();
        return;
    case C::toggle_wireframe:
        state.wireframe = !state.wireframe;
        return;
    case C::toggle_attachments:
        state.attachments = !state.attachments;
        return;
    case C::toggle_rest_ghost:
        state.rest_ghost = !state.rest_ghost;
        return;
    case C::toggle_joint_axis:
        state.joint_axis = !state.joint_axis;
        return;
    case C::next_colouring:
        state.colouring = static_cast<view::Colouring>((static_cast<std::size_t>(state.colouring) + 1) %
                                                       view::colourings().size());
        return;
    case C::toggle_full_screen:
        state.wants_full_screen = !state.wants_full_screen;
        return;
    case C::toggle_theme:
        state.dark = !state.dark;
        return;
    case C::larger_interface:
        return set_scale(context, state.scale + scale_step);
    case C::smaller_interface:
        return set_scale(context, state.scale - scale_step);
    case C::normal_interface:
        return set_scale(context, state.start_scale);
    case C::show_shortcuts:
        state.show_shortcuts = !state.show_shortcuts;
        return;
    case C::escape:
        return escape(context);
    }
}

} // namespace fascicle::editor
