#pragma once
// All features of the editor; EditorContext knows only that there are some.

#include "editor/paint/paint_tool.hpp"
#include "editor/scene_opener.hpp"

namespace fascicle::editor {

struct Features {
    SceneOpener opener;
    PaintMode paint;
    PaintTool paint_tool{paint};

    std::vector<Feature*> all() { return {&opener, &paint}; }
};

} // namespace fascicle::editor
