#include "editor/theme.hpp"

#include <array>
#include <cmath>

namespace fascicle::editor {

namespace {

constexpr ImU32 rgb(unsigned hex, unsigned alpha = 255) {
    return IM_COL32((hex >> 16) & 255, (hex >> 8) & 255, hex & 255, alpha);
}

Theme make_dark() {
    Theme t{};
    t.dark = true;
    t.gap = rgb(0x0d0f13);
    t.bar = rgb(0x1c2027);
    t.panel = rgb(0x191c22);
    t.header = rgb(0x20242c);
    t.field = rgb(0x2a2f39);
    t.field_hovered = rgb(0x343b47);
    t.field_active = rgb(0x3d4654);
    t.line = rgb(0x2e343e);
    t.text = rgb(0xe4e7ec);
    t.text_dim = rgb(0xa4acb9);
    t.text_faint = rgb(0x737c8a);
    t.accent = rgb(0x5a9cf0);
    t.accent_dim = rgb(0x31527e);
    t.on_accent = rgb(0xffffff);
    t.good = rgb(0x56c596);
    t.warning = rgb(0xe8b04a);
    t.bad = rgb(0xf0716a);
    t.valid = rgb(0x3f9e78);
    t.stale = rgb(0xb98a34);
    t.missing = rgb(0x2a2f39);
    t.plot = rgb(0x14161b);
    t.grid = rgb(0x292e37);
    t.playhead = rgb(0xffffff);
    t.hover_line = rgb(0x98a2b3, 150);
    t.badge = rgb(0x14161b, 205);
    t.origin = rgb(0xe0524a);
    t.insertion = rgb(0x4a86e0);
    t.view_top = {0.235f, 0.262f, 0.305f, 1.0f};
    t.view_bottom = {0.105f, 0.118f, 0.142f, 1.0f};
    return t;
}

Theme make_light() {
    Theme t{};
    t.dark = false;
    t.gap = rgb(0xb9c0ca);
    t.bar = rgb(0xe9ecf0);
    t.panel = rgb(0xf5f6f8);
    t.header = rgb(0xe6e9ee);
    t.field = rgb(0xdde2e9);
    t.field_hovered = rgb(0xd0d7e1);
    t.field_active = rgb(0xc2cbd8);
    t.line = rgb(0xcfd5dd);
    t.text = rgb(0x1d232c);
    t.text_dim = rgb(0x4d5867);
    t.text_faint = rgb(0x737d8b);
    t.accent = rgb(0x2468c4);
    t.accent_dim = rgb(0xb9d2f4);
    t.on_accent = rgb(0xffffff);
    t.good = rgb(0x1f8a5b);
    t.warning = rgb(0x9a6a08);
    t.bad = rgb(0xc0352d);
    t.valid = rgb(0x4fae86);
    t.stale = rgb(0xd6a343);
    t.missing = rgb(0xd3d9e1);
    t.plot = rgb(0xffffff);
    t.grid = rgb(0xe4e8ed);
    t.playhead = rgb(0x11151b);
    t.hover_line = rgb(0x55606f, 150);
    t.badge = rgb(0xffffff, 215);
    t.origin = rgb(0xcf3b33);
    t.insertion = rgb(0x2f6fd0);
    t.view_top = {0.955f, 0.962f, 0.972f, 1.0f};
    t.view_bottom = {0.800f, 0.825f, 0.855f, 1.0f};
    return t;
}

ImVec4 vec(ImU32 colour) {
    return ImGui::ColorConvertU32ToFloat4(colour);
}

} // namespace

const Theme& dark_theme() {
    static const Theme theme = make_dark();
    return theme;
}

const Theme& light_theme() {
    static const Theme theme = make_light();
    return theme;
}

ImGuiStyle make_style(const Theme& t) {
    ImGuiStyle style;
    style.WindowPadding = {10, 8};
    style.FramePadding = {8, 4};
    style.ItemSpacing = {8, 6};
    style.ItemInnerSpacing = {6, 4};
    style.CellPadding = {6, 3};
    style.IndentSpacing = 14;
    style.ScrollbarSize = 11;
    style.GrabMinSize = 9;
    style.WindowBorderSize = 0;
    style.ChildBorderSize = 0;
    style.PopupBorderSize = 1;
    style.FrameBorderSize = 0;
    style.WindowRounding = 0;
    style.ChildRounding = 4;
    style.FrameRounding = 4;
    style.PopupRounding = 5;
    style.ScrollbarRounding = 6;
    style.GrabRounding = 4;
    style.TabRounding = 4;
    style.WindowMenuButtonPosition = ImGuiDir_None;
    style.AntiAliasedLinesUseTex = true;

    ImVec4* c = style.Colors;
    c[ImGuiCol_Text] = vec(t.text);
    c[ImGuiCol_TextDisabled] = vec(t.text_faint);
    c[ImGuiCol_WindowBg] = vec(t.panel);
    c[ImGuiCol_ChildBg] = vec(0);
    c[ImGuiCol_PopupBg] = vec(t.header);
    c[ImGuiCol_Border] = vec(t.line);
    c[ImGuiCol_BorderShadow] = vec(0);
    c[ImGuiCol_FrameBg] = vec(t.field);
    c[ImGuiCol_FrameBgHovered] = vec(t.field_hovered);
    c[ImGuiCol_FrameBgActive] = vec(t.field_active);
    c[ImGuiCol_TitleBg] = vec(t.bar);
    c[ImGuiCol_TitleBgActive] = vec(t.bar);
    c[ImGuiCol_TitleBgCollapsed] = vec(t.bar);
    c[ImGuiCol_MenuBarBg] = vec(t.bar);
    c[ImGuiCol_ScrollbarBg] = vec(0);
    c[ImGuiCol_ScrollbarGrab] = vec(t.field_hovered);
    c[ImGuiCol_ScrollbarGrabHovered] = vec(t.field_active);
    c[ImGuiCol_ScrollbarGrabActive] = vec(t.accent);
    c[ImGuiCol_CheckMark] = vec(t.accent);
    c[ImGuiCol_SliderGrab] = vec(t.accent);
    c[ImGuiCol_SliderGrabActive] = vec(t.accent);
    c[ImGuiCol_Button] = vec(t.field);
    c[ImGuiCol_ButtonHovered] = vec(t.field_hovered);
    c[ImGuiCol_ButtonActive] = vec(t.field_active);
    c[ImGuiCol_Header] = vec(t.accent_dim);
    c[ImGuiCol_HeaderHovered] = vec(t.field_hovered);
    c[ImGuiCol_HeaderActive] = vec(t.field_active);
    c[ImGuiCol_Separator] = vec(t.line);
    c[ImGuiCol_SeparatorHovered] = vec(t.accent);
    c[ImGuiCol_SeparatorActive] = vec(t.accent);
    c[ImGuiCol_ResizeGrip] = vec(0);
    c[ImGuiCol_ResizeGripHovered] = vec(t.field_hovered);
    c[ImGuiCol_ResizeGripActive] = vec(t.accent);
    c[ImGuiCol_Tab] = vec(t.header);
    c[ImGuiCol_TabHovered] = vec(t.field_hovered);
    c[ImGuiCol_TabActive] = vec(t.panel);
    c[ImGuiCol_TabUnfocused] = vec(t.header);
    c[ImGuiCol_TabUnfocusedActive] = vec(t.panel);
    c[ImGuiCol_PlotHistogram] = vec(t.accent);
    c[ImGuiCol_TableHeaderBg] = vec(t.header);
    c[ImGuiCol_TableBorderStrong] = vec(t.line);
    c[ImGuiCol_TableBorderLight] = vec(t.line);
    c[ImGuiCol_TableRowBg] = vec(0);
    c[ImGuiCol_TableRowBgAlt] = vec(with_alpha(t.field, 0.35f));
    c[ImGuiCol_TextSelectedBg] = vec(t.accent_dim);
    c[ImGuiCol_DragDropTarget] = vec(t.accent);
    c[ImGuiCol_NavHighlight] = vec(t.accent);
    c[ImGuiCol_ModalWindowDimBg] = vec(with_alpha(t.gap, 0.55f));
    return style;
}

ImU32 curve_colour(const Theme& theme, int i) {
    static constexpr std::array<unsigned, 7> on_dark{0xe69f00, 0x56b4e9, 0x2fbf93, 0xcc79a7,
                                                     0xf0e442, 0xe4713a, 0x7f9bff};
    static constexpr std::array<unsigned, 7> on_light{0xc07f00, 0x0072b2, 0x008a64, 0xb04f88,
                                                      0x8a7d00, 0xc44e00, 0x4350c0};
    const auto k = static_cast<std::size_t>(i) % on_dark.size();
    return rgb(theme.dark ? on_dark[k] : on_light[k]);
}

ImU32 muted_curve_colour(const Theme& theme, int i) {
    const ImU32 colour = curve_colour(theme, i), grey = theme.text_faint;
    ImU32 mixed = IM_COL32_A_MASK;
    for (const int shift : {IM_COL32_R_SHIFT, IM_COL32_G_SHIFT, IM_COL32_B_SHIFT})
        mixed |= (((colour >> shift & 0xffu) + (grey >> shift & 0xffu)) / 2) << shift;
    return mixed;
}

ImU32 with_alpha(ImU32 colour, float alpha) {
    const auto value = static_cast<ImU32>(std::lround(alpha * 255.0f));
    return (colour & ~static_cast<ImU32>(IM_COL32_A_MASK)) | (value << IM_COL32_A_SHIFT);
}

} // namespace fascicle::editor
