#pragma once
// All features of the editor; EditorContext knows only that there are some.

#include "editor/scene_opener.hpp"

namespace fascicle::editor {

struct Features {
    SceneOpener opener;

    std::vector<Feature*> all() { return {&opener}; }
};

} // namespace fascicle::editor
