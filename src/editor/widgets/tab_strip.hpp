#pragma once
// The titles of the panels that share a place. Where they do not all fit, those in the back shrink to their icons.

#include "editor/editor_context.hpp"
#include "editor/widgets/icons.hpp"

namespace fascicle::editor {

struct Tab {
    const char* id; ///< widget name for tests: "tab/ID"
    std::string title;
    Icon icon; ///< empty glyph: the first letters of the title instead
    bool alarm = false;
};

/// Fills `strip`; returns the index of the tab that was clicked, or -1. A single tab is a plain heading. heading: its font.
int draw_tab_strip(const EditorContext& context, ImFont* heading, const std::vector<Tab>& tabs,
                   std::size_t front, const Rect& strip);

} // namespace fascicle::editor
