#pragma once
// All features of the editor; EditorContext knows only that there are some.

#include "editor/exporter.hpp"
#include "editor/scene_opener.hpp"

namespace fascicle::editor {

struct Features {
    SceneOpener opener;
    Exporter exporter;

    std::vector<Feature*> all() { return {&opener, &exporter}; }
};

} // namespace fascicle::editor
