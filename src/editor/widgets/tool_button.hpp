#pragma once
// Buttons that run a command: label, key, state and reason come from the key table.

#include "editor/commands.hpp"
#include "editor/widgets/icons.hpp"

namespace fascicle::editor {

/// A square button with an icon; lights up while the command is switched on. name: for tests.
void tool_button(EditorContext& context, const char* name, const Icon& icon, Command command,
                 float size = 30);
/// The same look for something that is no command. True when clicked.
bool icon_button(const EditorContext& context, const char* name, const Icon& icon, bool on, bool enabled,
                 const std::string& tip, float size = 30);
/// A menu line.
void menu_item(EditorContext& context, Command command);
/// Tooltip over the last item, after a short rest of the pointer, also over disabled ones.
void item_tooltip(const std::string& text);
/// A thin vertical line between groups of buttons on a line.
void toolbar_separator(const EditorContext& context, float height);

} // namespace fascicle::editor
