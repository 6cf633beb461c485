#include "editor/commands/command_groups.hpp"

namespace fascicle::editor {

using C = Command;
using namespace keys;

namespace {

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

} // namespace

std::vector<KeyBinding> show_commands() {
    const char* const show = "Show";
    return {
        {C::hide_selected,
         show,
         "Hide",
         "Hides what is selected.",
         {{{key_h}}},
         false,
         needs_selection,
         [](EditorContext& c) { c.state.hidden.insert(c.state.selection.name); }},
        {C::hide_others,
         show,
         "Hide the rest",
         "Hides everything but what is selected.",
         {{{key_h, shift}}},
         false,
         needs_selection,
         hide_others},
        {C::show_all,
         show,
         "Show all",
         "Makes everything visible again.",
         {{{key_h, alt}}},
         false,
         [](const EditorContext& c) { return only_if(!c.state.hidden.empty(), "everything is visible"); },
         [](EditorContext& c) { c.state.hidden.clear(); }},
        switch_row<&EditorState::wireframe>(C::toggle_wireframe, "Wireframe",
                                            "Draws the triangles' edges over the surfaces.", key_w),
        switch_row<&EditorState::attachments>(C::toggle_attachments, "Attachment areas",
                                              "Colours origins red and insertions blue.", key_a),
        switch_row<&EditorState::rest_ghost>(C::toggle_rest_ghost, "Rest shape",
                                             "Shows the muscles at rest as a faint ghost.", key_r),
        switch_row<&EditorState::joint_axis>(C::toggle_joint_axis, "Joint axis",
                                             "Draws the axis that the moving bones turn about.", key_j),
        {C::next_colouring,
         show,
         "Next colouring",
         "Goes through the quantities that muscles are coloured by.",
         {{{key_c}}},
         false,
         nullptr,
         [](EditorContext& c) {
             c.state.colouring = static_cast<view::Colouring>(
                 (static_cast<std::size_t>(c.state.colouring) + 1) % view::colourings().size());
         }},
    };
}

} // namespace fascicle::editor
