#pragma once
// All features of the editor; EditorContext knows only that there are some.

#include "editor/scene_opener.hpp"
#include "editor/viewport/fibre_hover.hpp"

namespace fascicle::editor {

struct Features {
    SceneOpener opener;
    FibreHover fibre_hover;

    std::vector<Feature*> all() { return {&opener, &fibre_hover}; }
};

} // namespace fascicle::editor
