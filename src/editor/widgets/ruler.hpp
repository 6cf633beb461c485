#pragma once
// The timeline's ruler: ticks, the motion as a faint curve, the cache bar and the playhead.

#include "editor/editor_context.hpp"

namespace fascicle::editor {

struct RulerResult {
    std::optional<int> moved_to; ///< the playhead was dragged here
    std::optional<double> hovered;
};

/// Fills `rect`. Widget name for tests: "timeline/ruler"; its first and last pixel columns are frames 0 and last.
RulerResult draw_ruler(const EditorContext& context, const Rect& rect);

} // namespace fascicle::editor
