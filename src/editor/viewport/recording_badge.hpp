#pragma once
// A red dot and a counter while something is exported.

#include "editor/editor_context.hpp"

namespace fascicle::editor {

/// A row of viewport_overlays(). Widget name for tests: "viewport/recording".
void draw_recording_badge(EditorContext& context, ImDrawList& list, const Rect& area);

} // namespace fascicle::editor
