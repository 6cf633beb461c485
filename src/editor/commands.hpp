#pragma once
// What the rows of the key table do. Keys, menus, buttons and tests all come through here.

#include "editor/editor_context.hpp"

namespace fascicle::editor {

struct CommandState {
    bool enabled = true;
    bool checked = false; ///< for switches
    std::string reason;   ///< why it is not enabled
};

/// For rows of the table: enabled when a bone or muscle that exists is selected.
CommandState needs_selection(const EditorContext& context);

CommandState command_state(const EditorContext& context, Command command);
/// Nothing when it is not enabled.
void run_command(EditorContext& context, Command command);

/// Box of the named bone or muscle in the shown frame; empty when there is none.
BoundingBox object_bounds(const EditorContext& context, const Selection& object);
/// Box of everything visible in the shown frame.
BoundingBox scene_bounds(const EditorContext& context);

} // namespace fascicle::editor
