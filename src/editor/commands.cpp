#include "editor/commands.hpp"

#include "editor/control_guard.hpp"

namespace fascicle::editor {

namespace {

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

CommandState needs_selection(const EditorContext& context) {
    const Selection& selection = context.state.selection;
    const Scene& scene = context.document.scene();
    const bool there = (selection.kind == Selection::Kind::bone && scene.bone_index(selection.name) >= 0) ||
                       (selection.kind == Selection::Kind::muscle && scene.muscle_index(selection.name) >= 0);
    return {there, false, there ? "" : "nothing is selected"};
}

CommandState command_state(const EditorContext& context, Command command) {
    const KeyBinding& row = binding(command);
    CommandState state = row.state == nullptr ? CommandState{} : row.state(context);
    if (std::string reason = lock_reason(std::string("command/") + row.label); !reason.empty()) {
        state.enabled = false;
        state.reason = std::move(reason);
    }
    return state;
}

void run_command(EditorContext& context, Command command) {
    const KeyBinding& row = binding(command);
    if (row.run != nullptr && command_state(context, command).enabled)
        row.run(context);
}

} // namespace fascicle::editor
