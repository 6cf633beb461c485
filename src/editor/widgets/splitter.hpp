#pragma once
// A border between two parts of the window that can be dragged.

#include "editor/layout.hpp"

namespace fascicle::editor {

enum class SplitAxis { x, y };

/// Draws nothing while it is left alone (the parts' gap is the line); lights up under the pointer. Returns how
/// far it was dragged in this frame, in pixels along its axis. To be called inside a window that lies over the
/// parts.
float splitter(const char* id, const Rect& line, SplitAxis axis, float scale);

} // namespace fascicle::editor
