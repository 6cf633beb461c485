#pragma once
// All features of the editor; EditorContext knows only that there are some.

#include "editor/project/autosave_keeper.hpp"
#include "editor/project/project_keeper.hpp"
#include "editor/project/source_watch.hpp"
#include "editor/scene_opener.hpp"
#include "editor/start/start_page.hpp"

namespace fascicle::editor {

struct Features {
    SceneOpener opener;
    ProjectKeeper project;
    AutosaveKeeper autosave;
    SourceWatch watch;
    StartPage start;

    std::vector<Feature*> all() { return {&opener, &project, &autosave, &watch, &start}; }
};

} // namespace fascicle::editor
