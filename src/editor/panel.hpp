#pragma once
// A part of the window. A new one is a pair of files in panels/ and a row in panels/registry.cpp.

#include "editor/editor_context.hpp"
#include "editor/widgets/icons.hpp"

#include <functional>
#include <memory>

namespace fascicle::editor {

class Panel {
public:
    virtual ~Panel() = default;
    /// Draws into the current ImGui window, which fills `area` (pixels). Called only while visible.
    virtual void draw(EditorContext& context, const Rect& area) = 0;
};

/// Where a panel sits. Panels of one place share it as tabs.
enum class Place { menu, toolbar, tree, inspector, viewport, parameters, timeline, bottom, status, lesson };

struct PanelRow {
    const char* id;
    const char* title; ///< null: no title strip
    Place place;
    bool padded;  ///< content keeps off the borders
    bool scrolls; ///< content may be longer than the place
    std::unique_ptr<Panel> (*make)();
    Icon icon{"", ""}; ///< where its title has no room
};

/// In the order of tabs.
const std::vector<PanelRow>& panel_registry();

} // namespace fascicle::editor
