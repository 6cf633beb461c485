#pragma once
// All features of the editor; EditorContext knows only that there are some.

#include "editor/file_loader.hpp"
#include "editor/motion_edit.hpp"
#include "editor/scene_opener.hpp"

namespace fascicle::editor {

struct Features {
    SceneOpener opener;
    FileLoader loader;
    MotionEdit motion;

    std::vector<Feature*> all() { return {&opener, &loader, &motion}; }
};

} // namespace fascicle::editor
