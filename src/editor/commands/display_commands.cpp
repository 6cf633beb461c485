#include "editor/commands/command_groups.hpp"

namespace fascicle::editor {

using C = Command;
using namespace keys;

namespace {

void toggle_see_through(EditorContext& context) {
    EditorState& state = context.state;
    if (state.muscle_opacity < 1) {
        state.see_through_opacity = state.muscle_opacity;
        state.muscle_opacity = 1;
    } else {
        state.muscle_opacity = state.see_through_opacity;
    }
}

void toggle_section(EditorContext& context) {
    EditorState& state = context.state;
    state.section.on = !state.section.on;
    if (state.section.on)
        orient(state.section, state.section.axis, state.camera, section_place(context));
}

void show_display(EditorContext& context) {
    EditorState& state = context.state;
    const bool there = state.layout.show_right && state.side_panel == "display";
    state.layout.show_right = true;
    state.side_panel = there ? "parameters" : "display";
}

} // namespace

std::vector<KeyBinding> display_commands() {
    const char* const show = "Show";
    return {
        {C::toggle_see_through,
         show,
         "Transparent muscles",
         "Lets what is inside and behind the muscles be seen, fibres among it.",
         {{{key_t}}},
         false,
         [](const EditorContext& c) { return checked(c.state.muscle_opacity < 1); },
         toggle_see_through},
        switch_row<&EditorState::fibres>(
            C::toggle_fibres, "Fibres",
            "Draws the fibres inside of muscles that are transparent or coloured by them."),
        switch_row<&EditorState::line_muscles>(C::toggle_line_muscles, "Line muscles",
                                               "Draws the muscles of the scene's line model."),
        switch_row<&EditorState::occlusion>(
            C::toggle_occlusion, "Ambient occlusion",
            "Darkens places that others shade, so that shape reads; on a slow machine once nothing moves.",
            key_l),
        {C::toggle_section,
         show,
         "Section plane",
         "Cuts everything open through the middle of the selection or of the muscles; Ctrl+wheel moves the "
         "cut.",
         {{{key_s}}},
         false,
         [](const EditorContext& c) { return checked(c.state.section.on); },
         toggle_section},
        {C::flip_section,
         show,
         "Flip section",
         "Takes the other side of the section plane away.",
         {{{key_s, shift}}},
         false,
         [](const EditorContext& c) {
             CommandState state = only_if(c.state.section.on, "there is no section plane");
             state.checked = c.state.section.on && c.state.section.flipped;
             return state;
         },
         [](EditorContext& c) { c.state.section.flipped = !c.state.section.flipped; }},
        {C::show_display,
         show,
         "Display settings",
         "Shows colours, opacities, section plane and what else the picture depends on.",
         {{{key_d}}},
         false,
         [](const EditorContext& c) {
             return checked(c.state.layout.show_right && c.state.side_panel == "display");
         },
         show_display},
    };
}

} // namespace fascicle::editor
