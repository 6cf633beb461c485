#pragma once
// Colours of the interface, dark and light, and the ImGui style made from them.

#include "render/draw_list.hpp"

#include <imgui.h>

namespace fascicle::editor {

struct Theme {
    bool dark = true;
    ImU32 gap;    ///< between the parts of the window
    ImU32 bar;    ///< menu, tool and status bar
    ImU32 panel;  ///< background of panels
    ImU32 header; ///< title strip of a panel
    ImU32 field;  ///< inputs at rest
    ImU32 field_hovered, field_active;
    ImU32 line; ///< hairlines
    ImU32 text, text_dim, text_faint;
    ImU32 accent, accent_dim, on_accent;
    ImU32 good, warning, bad;
    ImU32 valid, stale, missing; ///< cache bar
    ImU32 plot, grid, playhead, hover_line;
    ImU32 badge; ///< behind text that lies over the view
    ImU32 origin, insertion;
    render::Rgba view_top, view_bottom;
};

const Theme& dark_theme();
const Theme& light_theme();

/// At scale 1.
ImGuiStyle make_style(const Theme& theme);

/// Colour of the i-th curve: told apart also by people who cannot tell red from green (Okabe and Ito 2008).
ImU32 curve_colour(const Theme& theme, int i);
/// The same colours half way to grey: what is shown for comparison.
ImU32 muted_curve_colour(const Theme& theme, int i);
/// The same colour with its alpha replaced, 0 to 1.
ImU32 with_alpha(ImU32 colour, float alpha);

} // namespace fascicle::editor
