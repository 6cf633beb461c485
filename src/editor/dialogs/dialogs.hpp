#pragma once
// All dialogs of the editor; EditorContext knows only that there are some.

#include "editor/dialogs/load_dialog.hpp"
#include "editor/dialogs/mesh_dialog.hpp"
#include "editor/dialogs/picture_dialog.hpp"

namespace fascicle::editor {

struct Dialogs {
    MeshDialog mesh;
    LoadDialog load;
    PictureDialog picture;

    std::vector<Dialog*> all() { return {&mesh, &load, &picture}; }
};

} // namespace fascicle::editor
