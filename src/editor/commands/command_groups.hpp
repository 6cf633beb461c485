#pragma once
// The rows of the command table, one file a group. A new command is a name in Command (key_bindings.hpp) and a row here.

#include "editor/commands.hpp"

namespace fascicle::editor {

std::vector<KeyBinding> project_commands();
std::vector<KeyBinding> file_commands();
std::vector<KeyBinding> export_commands();
std::vector<KeyBinding> load_commands();
std::vector<KeyBinding> edit_commands();
std::vector<KeyBinding> timeline_commands();
std::vector<KeyBinding> view_commands();
std::vector<KeyBinding> show_commands();
std::vector<KeyBinding> plot_commands();
std::vector<KeyBinding> paint_commands();
std::vector<KeyBinding> display_commands();
std::vector<KeyBinding> window_commands();
std::vector<KeyBinding> lesson_commands();
std::vector<KeyBinding> compare_commands();

namespace keys {
constexpr Modifiers ctrl{.ctrl = true};
constexpr Modifiers shift{.shift = true};
constexpr Modifiers alt{.alt = true};
constexpr Modifiers ctrl_shift{.ctrl = true, .shift = true};
constexpr KeyChord pad(int digit, Modifiers modifiers = {}) {
    return {key_pad_0 + digit, modifiers};
}
} // namespace keys

/// Enabled, or not with the reason.
inline CommandState only_if(bool enabled, const char* reason) {
    return {enabled, false, enabled ? "" : reason};
}
inline CommandState checked(bool on) {
    return {true, on, {}};
}

/// A switch of the view state.
template <bool EditorState::*member>
KeyBinding switch_row(Command command, const char* label, const char* help, int key = key_none) {
    return {command,
            "Show",
            label,
            help,
            {{{key}}},
            false,
            [](const EditorContext& c) { return checked(c.state.*member); },
            [](EditorContext& c) { c.state.*member = !(c.state.*member); }};
}

} // namespace fascicle::editor
