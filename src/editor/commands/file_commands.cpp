#include "editor/commands/command_groups.hpp"
#include "editor/dialogs/dialogs.hpp"
#include "editor/project/project_flow.hpp"

namespace fascicle::editor {

using C = Command;
using namespace keys;

std::vector<KeyBinding> file_commands() {
    const char* const file = "File";
    return {
        {C::open_file,
         file,
         "Add meshes...",
         "Loads bones and muscles from mesh files.",
         {{{key_i, ctrl}}},
         false,
         nullptr,
         [](EditorContext& c) {
             c.state.show_start = false;
             c.dialogs.mesh.open();
         }},
        {C::save_picture,
         file,
         "Save picture",
         "Writes the view as a PNG into the current folder.",
         {{{key_f12}}},
         false,
         nullptr,
         [](EditorContext& c) {
             c.state.wants_picture = next_picture_name(c.document.scene().name, c.playhead());
         }},
        {C::save_picture_as,
         file,
         "Save picture as...",
         "Writes the view as a PNG under a name you choose.",
         {{{key_f12, shift}}},
         false,
         nullptr,
         [](EditorContext& c) {
             c.dialogs.picture.open(next_picture_name(c.document.scene().name, c.playhead()));
         }},
        {C::quit, file, "Quit", "Closes the program.", {{{key_q, ctrl}}}, false, nullptr, quit},
    };
}

} // namespace fascicle::editor
