#pragma once
// All features of the editor; EditorContext knows only that there are some.

#include "editor/compare.hpp"
#include "editor/exporter.hpp"
#include "editor/paint/paint_tool.hpp"
#include "editor/plot_data.hpp"
#include "editor/run_shelf.hpp"
#include "editor/scene_opener.hpp"
#include "editor/settings.hpp"

namespace fascicle::editor {

struct Features {
    SettingsKeeper settings;
    SceneOpener opener;
    PaintMode paint;
    PaintTool paint_tool{paint};
    RunShelf shelf;
    Compare compare;
    Exporter exporter;
    PlotData plots;

    std::vector<Feature*> all() { return {&settings, &opener, &paint, &shelf, &compare, &exporter, &plots}; }
};

} // namespace fascicle::editor
