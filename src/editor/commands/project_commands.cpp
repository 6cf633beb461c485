#include "editor/commands/command_groups.hpp"
#include "editor/dialogs/dialogs.hpp"
#include "editor/features.hpp"
#include "editor/project/project_flow.hpp"

namespace fascicle::editor {

using C = Command;
using namespace keys;

namespace {

CommandState can_save(const EditorContext& context) {
    return only_if(!context.features.project.saving(), "it is being saved");
}

} // namespace

std::vector<KeyBinding> project_commands() {
    const char* const file = "File";
    return {
        {C::new_project,
         file,
         "New",
         "Begins with an empty scene.",
         {{{key_n, ctrl}}},
         false,
         nullptr,
         new_project},
        {C::open_project,
         file,
         "Open project...",
         "Opens a project (.fascicle) in place of this scene.",
         {{{key_o, ctrl}}},
         false,
         nullptr,
         choose_project},
        {C::open_model,
         file,
         "Open OpenSim model...",
         "Makes a scene of a model (.osim) and a trial (.mot, .sto) that moves its bones.",
         {},
         false,
         nullptr,
         [](EditorContext& c) { c.dialogs.osim.open(); }},
        {C::save_project,
         file,
         "Save",
         "Writes the project into its file.",
         {{{key_s, ctrl}}},
         false,
         can_save,
         [](EditorContext& c) { save_project(c); }},
        {C::save_project_as,
         file,
         "Save as...",
         "Writes the project under a name you choose, with its meshes inside if you like.",
         {{{key_s, ctrl_shift}}},
         false,
         can_save,
         [](EditorContext& c) { save_project_as(c); }},
        {C::show_start_page,
         file,
         "Start page",
         "Recent projects and scenes to begin with.",
         {},
         false,
         [](const EditorContext& c) { return checked(c.state.show_start); },
         [](EditorContext& c) { c.state.show_start = !c.state.show_start; }},
    };
}

} // namespace fascicle::editor
