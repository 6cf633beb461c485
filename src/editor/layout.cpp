#include "editor/layout.hpp"

#include "editor/widgets/splitter.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::editor {

namespace {

constexpr float menu_height = 27, toolbar_height = 42, status_height = 26, timeline_height = 84;
constexpr float least_view_width = 240, least_view_height = 110;
constexpr float view_width_beside_lesson = 520; ///< that scene and selection leave to the view
constexpr float least_side = 160, most_side = 560, least_bottom = 110, most_bottom = 700;

} // namespace

Layout compute_layout(float width, float height, const LayoutSizes& sizes, float scale) {
    Layout layout;
    layout.gap = std::max(1.0f, std::round(scale));
    const float gap = layout.gap;
    const auto px = [&](float value) { return std::round(value * scale); };

    float top = 0;
    const auto take_row = [&](float rows) {
        const Rect rect{{0, top}, {width, std::min(height, top + rows)}};
        top = rect.max.y;
        return rect;
    };
    layout.menu = take_row(px(menu_height));
    layout.toolbar = take_row(px(toolbar_height));
    top += gap;
    float bottom = height;
    if (bottom - px(status_height) > top + px(60)) {
        layout.status = {{0, bottom - px(status_height)}, {width, bottom}};
        bottom = layout.status.min.y - gap;
    }

    // Columns: the right one goes first when it gets narrow.
    float left = 0, right = width, start = 0;
    const float wanted_left = px(std::clamp(sizes.left, least_side, most_side));
    const float wanted_right = px(std::clamp(sizes.right, least_side, most_side));
    if (sizes.show_right && width - wanted_right - gap >= px(least_view_width)) {
        layout.parameters = {{width - wanted_right, top}, {width, bottom}};
        right = layout.parameters.min.x - gap;
    }
    if (sizes.show_lesson) {
        // The lesson is what is looked at: the right column gives way to it, too.
        const float wanted = px(std::clamp(sizes.lesson, least_side, most_side));
        if (right - wanted - gap < px(least_view_width)) {
            layout.parameters = {};
            right = width;
        }
        layout.lesson = {{0, top}, {std::min(wanted, width), bottom}};
        start = left = layout.lesson.max.x + gap;
    }
    const float least_width = px(sizes.show_lesson ? view_width_beside_lesson : least_view_width);
    if (sizes.show_left && right - start - wanted_left - gap >= least_width)
        left = start + wanted_left + gap;

    // Rows under the view span the left column too.
    if (bottom - top - px(timeline_height) - gap >= px(40)) {
        float below = bottom;
        const float wanted = px(std::clamp(sizes.bottom, least_bottom, most_bottom));
        const float room = below - top - px(timeline_height) - 2 * gap - px(least_view_height);
        if (sizes.show_bottom && room >= px(least_bottom)) {
            layout.bottom = {{start, below - std::min(wanted, room)}, {right, below}};
            below = layout.bottom.min.y - gap;
        }
        layout.timeline = {{start, below - px(timeline_height)}, {right, below}};
        bottom = layout.timeline.min.y - gap;
    }
    layout.viewport = {{left, top}, {right, bottom}};
    if (left > start) {
        const float share = std::clamp(sizes.tree_share, 0.2f, 0.8f);
        const float split = std::round(top + (bottom - top) * share);
        layout.tree = {{start, top}, {left - gap, split}};
        layout.inspector = {{start, split + gap}, {left - gap, bottom}};
    }
    return layout;
}

void drag_borders(const Layout& layout, LayoutSizes& sizes, float scale) {
    if (!layout.lesson.empty()) {
        const float x = layout.lesson.max.x;
        const float moved =
            splitter("border/lesson", {{x, layout.lesson.min.y}, {x + layout.gap, layout.lesson.max.y}},
                     SplitAxis::x, scale);
        sizes.lesson = std::clamp(sizes.lesson + moved / scale, least_side, most_side);
    }
    if (!layout.tree.empty()) {
        const float x = layout.tree.max.x;
        const float moved =
            splitter("border/left", {{x, layout.viewport.min.y}, {x + layout.gap, layout.viewport.max.y}},
                     SplitAxis::x, scale);
        sizes.left = std::clamp(sizes.left + moved / scale, least_side, most_side);
        const float y = layout.tree.max.y;
        const float down =
            splitter("border/tree", {{layout.tree.min.x, y}, {layout.tree.max.x, y + layout.gap}},
                     SplitAxis::y, scale);
        const float column = layout.inspector.max.y - layout.tree.min.y;
        sizes.tree_share = std::clamp(sizes.tree_share + down / std::max(1.0f, column), 0.2f, 0.8f);
    }
    if (!layout.parameters.empty()) {
        const float x = layout.parameters.min.x - layout.gap;
        const float moved = splitter(
            "border/right", {{x, layout.parameters.min.y}, {x + layout.gap, layout.parameters.max.y}},
            SplitAxis::x, scale);
        sizes.right = std::clamp(sizes.right - moved / scale, least_side, most_side);
    }
    if (!layout.bottom.empty()) {
        const float y = layout.bottom.min.y - layout.gap;
        const float moved =
            splitter("border/bottom", {{layout.bottom.min.x, y}, {layout.bottom.max.x, y + layout.gap}},
                     SplitAxis::y, scale);
        sizes.bottom = std::clamp(sizes.bottom - moved / scale, least_bottom, most_bottom);
    }
}

} // namespace fascicle::editor
