#pragma once
// All dialogs of the editor; EditorContext knows only that there are some.

#include "editor/dialogs/command_search.hpp"
#include "editor/dialogs/export_dialog.hpp"
#include "editor/dialogs/load_dialog.hpp"
#include "editor/dialogs/mesh_dialog.hpp"
#include "editor/dialogs/picture_dialog.hpp"
#include "editor/dialogs/run_dialog.hpp"

namespace fascicle::editor {

struct Dialogs {
    CommandSearch search;
    MeshDialog mesh;
    LoadDialog load;
    PictureDialog picture;
    RunDialog run;
    ExportDialog exporting;

    std::vector<Dialog*> all() { return {&search, &mesh, &picture, &run, &exporting, &load}; }
};

} // namespace fascicle::editor
