#pragma once
// The timeline's ruler: ticks, the motion as a faint curve, the cache bar, markers, the handles of the frames that are played,
// and the playhead.

#include "editor/editor_context.hpp"

namespace fascicle::editor {

/// What a press on the ruler took hold of; kept from frame to frame by whoever draws the ruler.
struct RulerGrab {
    enum class What { none, playhead, first, last, marker };
    What what = What::none;
    std::size_t marker = 0; ///< index
    int frame = 0;          ///< where the marker is being dragged to
};

struct RulerResult {
    std::optional<int> moved_to; ///< the playhead was dragged here
    std::optional<double> hovered;
    std::optional<std::pair<int, int>> range;                ///< the handles were dragged here
    std::optional<std::pair<std::size_t, int>> moved_marker; ///< index, and the frame it was dropped at
    std::optional<int> double_clicked, menu_at;              ///< frames; menu: the right button
    std::optional<std::size_t> menu_marker;                  ///< the marker under the menu
};

/// Fills `rect`. Widget names for tests: "timeline/ruler", whose first and last pixel columns are frames 0 and last,
/// "timeline/cache", "timeline/range/first" and "/last" (the handles), "timeline/marker/NAME".
RulerResult draw_ruler(const EditorContext& context, const Rect& rect, RulerGrab& grab);

} // namespace fascicle::editor
