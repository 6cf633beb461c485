#include "editor/commands/command_groups.hpp"
#include "editor/dialogs/dialogs.hpp"

#include <algorithm>

namespace fascicle::editor {

using C = Command;
using namespace keys;

namespace {

constexpr float least_scale = 0.75f, most_scale = 3.0f, scale_step = 0.25f;

void set_scale(EditorContext& context, float scale) {
    context.state.scale = std::clamp(scale, least_scale, most_scale);
}

} // namespace

std::vector<KeyBinding> window_commands() {
    const char* const window = "Window";
    return {
        {C::search_commands,
         window,
         "Find a command...",
         "Finds any command by its name.",
         {{{key_k, ctrl}}},
         false,
         nullptr,
         [](EditorContext& c) { c.dialogs.search.open(); }},
        {C::present,
         window,
         "Presenter",
         "Full screen, with text and controls half as large again.",
         {{{key_f11, shift}}},
         false,
         [](const EditorContext& c) { return checked(c.state.presenting); },
         [](EditorContext& c) {
             EditorState& state = c.state;
             state.presenting = !state.presenting;
             state.wants_full_screen = state.presenting;
             set_scale(c, state.presenting ? state.start_scale * 1.5f : state.start_scale);
         }},
        {C::toggle_full_screen,
         window,
         "Full screen",
         "Fills the screen, or goes back to a window.",
         {{{key_f11}}},
         false,
         [](const EditorContext& c) { return checked(c.state.wants_full_screen); },
         [](EditorContext& c) { c.state.wants_full_screen = !c.state.wants_full_screen; }},
        {C::toggle_theme,
         window,
         "Light theme",
         "Switches between dark and light.",
         {},
         false,
         [](const EditorContext& c) { return checked(!c.state.dark); },
         [](EditorContext& c) { c.state.dark = !c.state.dark; }},
        {C::larger_interface,
         window,
         "Larger interface",
         "Text and controls 25 % larger, up to 300 %.",
         {{{key_equal, ctrl}, {key_equal, ctrl_shift}}},
         true,
         nullptr,
         [](EditorContext& c) { set_scale(c, c.state.scale + scale_step); }},
        {C::smaller_interface,
         window,
         "Smaller interface",
         "Text and controls 25 % smaller, down to 75 %.",
         {{{key_minus, ctrl}}},
         true,
         nullptr,
         [](EditorContext& c) { set_scale(c, c.state.scale - scale_step); }},
        {C::normal_interface,
         window,
         "Normal interface size",
         "Back to the size the program started with.",
         {{{key_0, ctrl}}},
         false,
         nullptr,
         [](EditorContext& c) { set_scale(c, c.state.start_scale); }},
        {C::show_shortcuts,
         window,
         "Keyboard shortcuts",
         "Shows or hides the list of keys.",
         {{{key_f1}, {key_slash, shift}}},
         false,
         [](const EditorContext& c) { return checked(c.state.show_shortcuts); },
         [](EditorContext& c) { c.state.show_shortcuts = !c.state.show_shortcuts; }},
    };
}

} // namespace fascicle::editor
