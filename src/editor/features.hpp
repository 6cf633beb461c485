#pragma once
// All features of the editor; EditorContext knows only that there are some.

#include "editor/plot_data.hpp"
#include "editor/scene_opener.hpp"

namespace fascicle::editor {

struct Features {
    SceneOpener opener;
    PlotData plots;

    std::vector<Feature*> all() { return {&opener, &plots}; }
};

} // namespace fascicle::editor
