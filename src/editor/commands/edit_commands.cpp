#include "editor/commands/command_groups.hpp"
#include "editor/dialogs/dialogs.hpp"
#include "editor/features.hpp"
#include "editor/viewport_tool.hpp"
#include "fascicle/document/actions/scene_actions.hpp"

namespace fascicle::editor {

using C = Command;
using namespace keys;

namespace {

void remove_selected(EditorContext& context) {
    const Selection selection = context.state.selection;
    const Scene& scene = context.document.scene();
    if (selection.kind == Selection::Kind::bone)
        actions::remove_bone(context.document, scene.bone_index(selection.name));
    else
        actions::remove_muscle(context.document, scene.muscle_index(selection.name));
    context.state.selection = {};
}

/// Esc: the change under way first, then what is open, then jobs, then the tool, then the selection.
void escape(EditorContext& context) {
    EditorState& state = context.state;
    ViewportTool* tool = active_tool(context);
    if (tool != nullptr && tool->cancel(context))
        return;
    if (context.document.has_uncommitted_edits())
        context.document.discard_edits();
    else if (state.show_shortcuts)
        state.show_shortcuts = false;
    else if (context.features.exporter.running())
        context.features.exporter.cancel();
    else if (state.tool == Tool::pick_point)
        state.tool = Tool::look;
    else if (context.features.loader.reading())
        context.features.loader.cancel();
    else if (context.runs.running())
        run_command(context, C::cancel_run);
    else if (tool != nullptr)
        context.features.paint.leave(context);
    else
        state.selection = {};
}

} // namespace

std::vector<KeyBinding> edit_commands() {
    const char* const edit = "Edit";
    return {
        {C::undo,
         edit,
         "Undo",
         "Takes back the last change of the scene; the camera stays.",
         {{{key_z, ctrl}}},
         true,
         [](const EditorContext& c) {
             return only_if(c.document.has_uncommitted_edits() || c.document.history().can_undo(),
                            "nothing to take back");
         },
         [](EditorContext& c) { c.document.undo(); }},
        {C::redo,
         edit,
         "Redo",
         "Does again what was taken back.",
         {{{key_z, ctrl_shift}, {key_y, ctrl}}},
         true,
         [](const EditorContext& c) {
             return only_if(c.document.history().can_redo(), "nothing to do again");
         },
         [](EditorContext& c) { c.document.redo(); }},
        {C::repair_mesh,
         edit,
         "Repair mesh...",
         "Closes holes, parts what is glued, smooths, remeshes: of the selected bone or muscle.",
         {},
         false,
         needs_selection,
         [](EditorContext& c) { c.dialogs.repair.open(c); }},
        {C::remove_selected,
         edit,
         "Remove",
         "Removes the selected bone or muscle from the scene.",
         {{{key_delete}}},
         false,
         needs_selection,
         remove_selected},
        {C::deselect,
         edit,
         "Deselect",
         "Selects nothing.",
         {},
         false,
         [](const EditorContext& c) {
             return only_if(c.state.selection.kind != Selection::Kind::none, "nothing is selected");
         },
         [](EditorContext& c) { c.state.selection = {}; }},
        {C::escape,
         edit,
         "Cancel",
         "Ends what is under way; without anything, closes what is open; else selects nothing.",
         {{{key_escape}}},
         false,
         nullptr,
         escape},
    };
}

} // namespace fascicle::editor
