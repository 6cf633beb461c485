#pragma once
// All features of the editor; EditorContext knows only that there are some.

#include "editor/scene_opener.hpp"
#include "editor/settings.hpp"

namespace fascicle::editor {

struct Features {
    Settings settings;
    SceneOpener opener;

    std::vector<Feature*> all() { return {&settings, &opener}; }
};

} // namespace fascicle::editor
