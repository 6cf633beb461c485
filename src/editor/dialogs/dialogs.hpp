#pragma once
// All dialogs of the editor; EditorContext knows only that there are some.

#include "editor/dialogs/mesh_dialog.hpp"
#include "editor/dialogs/picture_dialog.hpp"
#include "editor/dialogs/plot_export_dialog.hpp"
#include "editor/dialogs/plot_overlay_dialog.hpp"

namespace fascicle::editor {

struct Dialogs {
    MeshDialog mesh;
    PictureDialog picture;
    PlotExportDialog plot_export;
    PlotOverlayDialog plot_overlay;

    std::vector<Dialog*> all() { return {&mesh, &picture, &plot_export, &plot_overlay}; }
};

} // namespace fascicle::editor
