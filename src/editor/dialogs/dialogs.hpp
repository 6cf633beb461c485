#pragma once
// All dialogs of the editor; EditorContext knows only that there are some.

#include "editor/dialogs/command_search.hpp"
#include "editor/dialogs/export_dialog.hpp"
#include "editor/dialogs/load_dialog.hpp"
#include "editor/dialogs/locate_dialog.hpp"
#include "editor/dialogs/mesh_dialog.hpp"
#include "editor/dialogs/open_project_dialog.hpp"
#include "editor/dialogs/osim_dialog.hpp"
#include "editor/dialogs/pick_file_dialog.hpp"
#include "editor/dialogs/picture_dialog.hpp"
#include "editor/dialogs/plot_export_dialog.hpp"
#include "editor/dialogs/plot_overlay_dialog.hpp"
#include "editor/dialogs/progress_note.hpp"
#include "editor/dialogs/recovery_dialog.hpp"
#include "editor/dialogs/reload_dialog.hpp"
#include "editor/dialogs/repair_dialog.hpp"
#include "editor/dialogs/run_dialog.hpp"
#include "editor/dialogs/save_dialog.hpp"
#include "editor/dialogs/unsaved_dialog.hpp"

namespace fascicle::editor {

struct Dialogs {
    CommandSearch search;
    MeshDialog mesh;
    LoadDialog load;
    PictureDialog picture;
    PickFileDialog pick;
    OpenProjectDialog open_project;
    OsimDialog osim;
    SaveDialog save;
    UnsavedDialog unsaved;
    LocateDialog locate;
    ReloadDialog reload;
    RepairDialog repair;
    RecoveryDialog recovery;
    ProgressNote progress;
    RunDialog run;
    ExportDialog exporting;
    PlotExportDialog plot_export;
    PlotOverlayDialog plot_overlay;

    std::vector<Dialog*> all() {
        return {&search, &mesh,        &picture,      &run,          &exporting, &load,
                &pick,   &plot_export, &plot_overlay, &open_project, &save,      &unsaved,
                &locate, &repair,      &reload,       &recovery,     &progress,  &osim};
    }
};

} // namespace fascicle::editor
