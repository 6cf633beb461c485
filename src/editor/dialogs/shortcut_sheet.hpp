#pragma once
// The list of keys, made from the key table.

#include "editor/editor_context.hpp"

namespace fascicle::editor {

/// Draws it over everything while EditorState::show_shortcuts is set.
void draw_shortcut_sheet(EditorContext& context);

} // namespace fascicle::editor
