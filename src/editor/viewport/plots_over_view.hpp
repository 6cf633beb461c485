#pragma once
// One or two plots in the lower right corner of the view.

#include "editor/viewport_tool.hpp"

namespace fascicle::editor {

void draw_plots_over_view(EditorContext& context, ImDrawList& list, const Rect& area);

} // namespace fascicle::editor
