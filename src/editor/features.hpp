#pragma once
// All features of the editor; EditorContext knows only that there are some.

#include "editor/compare.hpp"
#include "editor/exporter.hpp"
#include "editor/fibres/fibre_preview.hpp"
#include "editor/file_loader.hpp"
#include "editor/motion_edit.hpp"
#include "editor/paint/paint_tool.hpp"
#include "editor/plot_data.hpp"
#include "editor/presets/preset_store.hpp"
#include "editor/project/autosave_keeper.hpp"
#include "editor/project/project_keeper.hpp"
#include "editor/project/source_watch.hpp"
#include "editor/run_shelf.hpp"
#include "editor/scene_opener.hpp"
#include "editor/settings.hpp"
#include "editor/start/start_page.hpp"
#include "editor/teach/lesson_player.hpp"
#include "editor/viewport/fibre_hover.hpp"

namespace fascicle::editor {

struct Features {
    SettingsKeeper settings;
    SceneOpener opener;
    ProjectKeeper project;
    AutosaveKeeper autosave;
    SourceWatch watch;
    StartPage start;
    FibrePreview fibres;
    PresetStore presets;
    LessonPlayer lessons;
    PaintMode paint;
    PaintTool paint_tool{paint};
    RunShelf shelf;
    Compare compare;
    Exporter exporter;
    FibreHover fibre_hover;
    FileLoader loader;
    MotionEdit motion;
    PlotData plots;

    std::vector<Feature*> all() {
        return {&settings, &opener,  &paint,   &shelf, &compare, &exporter, &fibre_hover, &loader, &motion,
                &fibres,   &presets, &lessons, &plots, &project, &autosave, &watch,       &start};
    }
};

} // namespace fascicle::editor
