#pragma once
// All dialogs of the editor; EditorContext knows only that there are some.

#include "editor/dialogs/mesh_dialog.hpp"
#include "editor/dialogs/pick_file_dialog.hpp"
#include "editor/dialogs/picture_dialog.hpp"

namespace fascicle::editor {

struct Dialogs {
    MeshDialog mesh;
    PictureDialog picture;
    PickFileDialog pick;

    std::vector<Dialog*> all() { return {&mesh, &picture, &pick}; }
};

} // namespace fascicle::editor
