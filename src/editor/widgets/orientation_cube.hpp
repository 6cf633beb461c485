#pragma once
// The corner cube that shows how the view is turned, labelled A P L R S I; a click looks from that side.

#include "editor/widgets/paint.hpp"
#include "view/camera.hpp"

#include <optional>

namespace fascicle::editor {

struct CubeResult {
    std::optional<view::StandardView> clicked;
    bool hovered = false;
};

/// middle, radius: pixels. pointer: its place, and whether it may act here; clicked: it just clicked.
CubeResult draw_orientation_cube(ImDrawList& list, const view::Camera& camera, ImVec2 middle, float radius,
                                 ImVec2 pointer, bool may_act, bool clicked, const Theme& theme);

} // namespace fascicle::editor
