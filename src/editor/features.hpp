#pragma once
// All features of the editor; EditorContext knows only that there are some.

#include "editor/fibres/fibre_preview.hpp"
#include "editor/presets/preset_store.hpp"
#include "editor/scene_opener.hpp"
#include "editor/teach/lesson_player.hpp"

namespace fascicle::editor {

struct Features {
    SceneOpener opener;
    FibrePreview fibres;
    PresetStore presets;
    LessonPlayer lessons;

    std::vector<Feature*> all() { return {&opener, &fibres, &presets, &lessons}; }
};

} // namespace fascicle::editor
