#include "editor/commands/command_groups.hpp"
#include "editor/dialogs/dialogs.hpp"
#include "editor/features.hpp"

namespace fascicle::editor {

using C = Command;
using namespace keys;

std::vector<KeyBinding> export_commands() {
    const char* const file = "File";
    return {
        {C::export_run,
         file,
         "Export...",
         "Writes pictures, films, meshes, fibres, numbers or a report of the run.",
         {{{'E', ctrl}}},
         false,
         [](const EditorContext& c) {
             return only_if(!c.features.exporter.running(), "an export is under way (Esc cancels it)");
         },
         [](EditorContext& c) { c.dialogs.exporting.open(c); }},
        {C::cancel_export,
         file,
         "Cancel export",
         "Stops the export under way; nothing of it is left behind. Esc does it, too.",
         {},
         false,
         [](const EditorContext& c) { return only_if(c.features.exporter.running(), "nothing is exported"); },
         [](EditorContext& c) { c.features.exporter.cancel(); }},
    };
}

} // namespace fascicle::editor
