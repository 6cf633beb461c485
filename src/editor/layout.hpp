#pragma once
// Where the parts of the window are: fixed places with movable borders (this ImGui release has no docking).

#include <imgui.h>

namespace fascicle::editor {

struct Rect {
    ImVec2 min;
    ImVec2 max;
    float width() const { return max.x - min.x; }
    float height() const { return max.y - min.y; }
    bool empty() const { return width() <= 0 || height() <= 0; }
    bool contains(ImVec2 p) const { return p.x >= min.x && p.y >= min.y && p.x < max.x && p.y < max.y; }
};

/// What the user set: sizes at scale 1, in pixels.
struct LayoutSizes {
    float left = 236;
    float right = 340;
    float bottom = 222;
    float tree_share = 0.56f; ///< of the left column, for the scene tree
    bool show_left = true, show_right = true, show_bottom = true;
    float lesson = 300;
    bool show_lesson =
        false; ///< a column of its own at the left, in place of scene and selection where it is narrow
};

/// Places in pixels. Empty where there is no room: side columns and plots give way before the view does.
struct Layout {
    Rect menu, toolbar, tree, inspector, viewport, parameters, timeline, bottom, status, lesson;
    float gap = 1; ///< the borders' width
};

/// width, height: of the window; scale: of the interface.
Layout compute_layout(float width, float height, const LayoutSizes& sizes, float scale);

/// Draws the borders between the parts as handles and lets them be dragged.
void drag_borders(const Layout& layout, LayoutSizes& sizes, float scale);

} // namespace fascicle::editor
