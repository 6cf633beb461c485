#include "editor/widgets/tool_button.hpp"

#include "editor/control_guard.hpp"

#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/paint.hpp"

#include <imgui_internal.h>

namespace fascicle::editor {

void item_tooltip(const std::string& text) {
    constexpr float rest_seconds = 0.35f;
    if (!text.empty() && ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled) &&
        GImGui->HoveredIdTimer > rest_seconds) {
        ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding,
                            {ImGui::GetFontSize() * 0.6f, ImGui::GetFontSize() * 0.45f});
        ImGui::BeginTooltip();
        ImGui::PushTextWrapPos(ImGui::GetFontSize() * 26);
        ImGui::TextUnformatted(text.c_str());
        ImGui::PopTextWrapPos();
        ImGui::EndTooltip();
        ImGui::PopStyleVar();
    }
}

bool icon_button(const EditorContext& context, const char* name, const Icon& icon, bool on, bool enabled,
                 const std::string& tip, float size) {
    const std::string locked = lock_reason(name);
    enabled = enabled && locked.empty();
    const Theme& theme = context.theme;
    const float side = context.px(size);
    const float width = icons_available() ? side : text_size(icon.words).x + context.px(12);
    ImGui::PushID(name);
    ImGui::BeginDisabled(!enabled);
    const bool clicked = ImGui::InvisibleButton("button", {width, side});
    const Rect rect{ImGui::GetItemRectMin(), ImGui::GetItemRectMax()};
    record_item(name);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const bool hovered = enabled && ImGui::IsItemHovered();
    const float rounding = context.px(5);
    if (on)
        list.AddRectFilled(rect.min, rect.max, theme.accent_dim, rounding);
    if (enabled && ImGui::IsItemActive())
        list.AddRectFilled(rect.min, rect.max, theme.field_active, rounding);
    else if (hovered)
        list.AddRectFilled(rect.min, rect.max, on ? with_alpha(theme.accent, 0.35f) : theme.field_hovered,
                           rounding);
    const ImU32 colour = !enabled ? with_alpha(theme.text_faint, 0.55f) : on ? theme.text : theme.text_dim;
    draw_text_in(list, {{rect.min.x - 4, rect.min.y}, {rect.max.x + 4, rect.max.y}},
                 hovered ? theme.text : colour, text(icon), Align::centre);
    ImGui::EndDisabled();
    item_tooltip(locked.empty() ? tip : tip + "\nNot now: " + locked + ".");
    ImGui::PopID();
    return clicked && enabled;
}

void tool_button(EditorContext& context, const char* name, const Icon& icon, Command command, float size) {
    const CommandState state = command_state(context, command);
    const std::string why = state.enabled ? "" : "\nNot now: " + state.reason + ".";
    if (icon_button(context, name, icon, state.checked, state.enabled, tooltip(command) + why, size))
        run_command(context, command);
}

void menu_item(EditorContext& context, Command command) {
    const KeyBinding& row = binding(command);
    const CommandState state = command_state(context, command);
    if (ImGui::MenuItem(row.label, shortcut(command).c_str(), state.checked, state.enabled))
        run_command(context, command);
    record_item(std::string("menu/") + row.label);
    item_tooltip(state.enabled ? row.help : row.help + ("\nNot now: " + state.reason + "."));
}

void toolbar_separator(const EditorContext& context, float height) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float x = std::round(at.x + context.px(3));
    ImGui::GetWindowDrawList()->AddLine({x, at.y + height * 0.18f}, {x, at.y + height * 0.82f},
                                        context.theme.line, std::max(1.0f, context.scale()));
    ImGui::Dummy({context.px(6), height});
}

} // namespace fascicle::editor
