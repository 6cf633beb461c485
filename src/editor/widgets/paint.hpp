#pragma once
// Small drawing helpers over ImDrawList.

#include "editor/layout.hpp"
#include "editor/theme.hpp"
#include "view/ticks.hpp"

#include <string_view>

namespace fascicle::editor {

enum class Align { left, centre, right };

/// One line of text inside `rect`, centred vertically, cut off (with an ellipsis) where it does not fit.
void draw_text_in(ImDrawList& list, const Rect& rect, ImU32 colour, std::string_view text,
                  Align align = Align::left);
/// Text at a point, unclipped.
void draw_text(ImDrawList& list, ImVec2 at, ImU32 colour, std::string_view text);
ImVec2 text_size(std::string_view text);
/// The text, or as much of it as fits into `width` pixels with an ellipsis.
std::string elided(std::string_view text, float width);

/// Text on a rounded plate; returns its rectangle. `at`: its left, middle or right upper corner.
Rect draw_badge(ImDrawList& list, ImVec2 at, Align align, std::string_view text, ImU32 text_colour,
                ImU32 plate);
/// Diagonal stripes, for what is stale.
void draw_hatching(ImDrawList& list, const Rect& rect, ImU32 colour, float spacing, float thickness);

using view::nice_ticks;
using view::scale_ticks;
using view::tick_text;
using view::Ticks;
/// Four significant digits, or so; "-" when it is not finite.
std::string value_text(double value);

} // namespace fascicle::editor
