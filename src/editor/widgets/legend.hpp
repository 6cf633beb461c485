#pragma once
// What colours in the view mean.

#include "editor/widgets/paint.hpp"
#include "view/colour_map.hpp"

#include <span>
#include <string>

namespace fascicle::editor {

/// A colour bar with ticks on a plate whose upper right corner is `corner`. Returns the plate.
Rect draw_colour_bar(ImDrawList& list, ImVec2 corner, const std::string& title,
                     const view::ColourScale& scale, const Theme& theme, float ui_scale);

struct LegendEntry {
    std::string name;
    ImU32 colour;
};
/// Swatches with names on a plate whose upper right corner is `corner`. Returns the plate.
Rect draw_swatches(ImDrawList& list, ImVec2 corner, std::span<const LegendEntry> entries, const Theme& theme,
                   float ui_scale);

} // namespace fascicle::editor
