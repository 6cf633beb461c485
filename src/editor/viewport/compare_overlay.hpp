#pragma once
// Says over the picture which runs are seen, and what the colours of their difference mean.

#include "editor/viewport_tool.hpp"

namespace fascicle::editor {

void draw_compare_overlay(EditorContext& context, ImDrawList& list, const Rect& area);

/// The part of the viewport that shows run A, and B with `second`; the whole area unless two pictures are side by side.
Rect compare_part(const EditorContext& context, const Rect& area, bool second);

} // namespace fascicle::editor
