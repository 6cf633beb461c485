#include "editor/commands/command_groups.hpp"
#include "editor/dialogs/dialogs.hpp"
#include "editor/features.hpp"

namespace fascicle::editor {

using C = Command;
using namespace keys;

namespace {

CommandState needs_muscle(const EditorContext& context) {
    return only_if(!context.document.scene().muscles.empty(), "the scene has no muscle");
}

CommandState needs_bone(const EditorContext& context) {
    return only_if(!context.document.scene().bones.empty(), "the scene has no bone");
}

} // namespace

std::vector<KeyBinding> load_commands() {
    const char* const scene = "Scene";
    return {
        {C::load_attachments,
         scene,
         "Attachment outlines...",
         "Loads the borders of a muscle's origins and insertions from a table.",
         {},
         false,
         needs_muscle,
         [](EditorContext& c) { c.dialogs.load.open(FileKind::outlines); }},
        {C::load_surface_fibres,
         scene,
         "Surface fibres...",
         "Loads superficial fibres of a muscle from polylines.",
         {},
         false,
         needs_muscle,
         [](EditorContext& c) { c.dialogs.load.open(FileKind::mesh); }},
        {C::load_fibre_template,
         scene,
         "Fibre template...",
         "Loads a muscle's own arrangement of fibres.",
         {},
         false,
         needs_muscle,
         [](EditorContext& c) { c.dialogs.load.open(FileKind::fibre_template); }},
        {C::load_lines,
         scene,
         "Line muscles...",
         "Loads the muscles of an OpenSim model as lines, for comparison.",
         {},
         false,
         needs_bone,
         [](EditorContext& c) { c.dialogs.load.open(FileKind::model); }},
        {C::show_motion,
         scene,
         "Motion",
         "Shows the panel in which bones get their motion.",
         {{{'M', ctrl}}},
         false,
         nullptr,
         [](EditorContext& c) {
             c.state.layout.show_right = true;
             c.state.side_panel = "motion";
         }},
    };
}

} // namespace fascicle::editor
