#include "editor/widgets/setting_row.hpp"

#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/paint.hpp"
#include "editor/widgets/tool_button.hpp"

#include <algorithm>
#include <imgui_internal.h>

namespace fascicle::editor {

RowColumns row_columns(const EditorContext& context) {
    // Of the whole row, wherever in it the cursor is.
    const float width = ImGui::GetWindowContentRegionMax().x - ImGui::GetWindowContentRegionMin().x,
                reset = ImGui::GetFrameHeight();
    const float label = std::min(context.px(142), width * 0.42f);
    return {label, std::max(20.0f, width - label - reset - context.px(2)), reset};
}

void section_heading(const EditorContext& context, const char* title, bool first) {
    if (!first)
        ImGui::Dummy({1, context.px(4)});
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x, height = context.px(20);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    draw_text_in(list, {at, {at.x + width, at.y + height}}, context.theme.text_faint, title);
    const float x = at.x + text_size(title).x + context.px(8), y = std::round(at.y + height / 2);
    list.AddLine({x, y}, {at.x + width, y}, context.theme.line);
    ImGui::Dummy({width, height});
}

void row_label(const EditorContext& context, const char* label, const std::string& tip, bool edited,
               bool enabled) {
    const RowColumns columns = row_columns(context);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float height = ImGui::GetFrameHeight();
    draw_text_in(*ImGui::GetWindowDrawList(), {at, {at.x + columns.label - context.px(8), at.y + height}},
                 !enabled ? context.theme.text_faint
                 : edited ? context.theme.text
                          : context.theme.text_dim,
                 label);
    ImGui::Dummy({columns.label, height});
    item_tooltip(tip);
    ImGui::SameLine(0, 0);
}

bool row_reset(const EditorContext& context, const std::string& name, bool edited,
               const std::string& standard) {
    ImGui::SameLine(0, context.px(2));
    const float side = ImGui::GetFrameHeight();
    if (!edited) {
        ImGui::Dummy({side, side});
        return false;
    }
    return icon_button(context, (name + "/reset").c_str(), icons::reset, false, true,
                       "Back to the default, " + standard, side / context.scale());
}

bool slider_control(const EditorContext& context, const std::string& name, double& value, double low,
                    double high, double standard, const std::string& text, const std::string& tip) {
    const Theme& theme = context.theme;
    ImGui::PushID(name.c_str());
    const bool typing = ImGui::TempInputIsActive(ImGui::GetID("##value"));
    constexpr ImGuiCol own[] = {ImGuiCol_Text,          ImGuiCol_FrameBg,    ImGuiCol_FrameBgHovered,
                                ImGuiCol_FrameBgActive, ImGuiCol_SliderGrab, ImGuiCol_SliderGrabActive};
    if (!typing) // ImGui's own look is made invisible; it keeps the behaviour
        for (const ImGuiCol colour : own)
            ImGui::PushStyleColor(colour, ImU32{0});
    ImGui::SetNextItemWidth(row_columns(context).control);
    const bool changed = ImGui::SliderScalar("##value", ImGuiDataType_Double, &value, &low, &high, "%.4f",
                                             ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoRoundToFormat);
    if (!typing)
        ImGui::PopStyleColor(6);
    record_item(name);
    if (!typing) {
        const Rect frame{ImGui::GetItemRectMin(), ImGui::GetItemRectMax()};
        ImDrawList& list = *ImGui::GetWindowDrawList();
        const float alpha = ImGui::GetStyle().Alpha, rounding = ImGui::GetStyle().FrameRounding;
        const bool hovered = ImGui::IsItemHovered() || ImGui::IsItemActive();
        const float grab = ImGui::GetStyle().GrabMinSize, from = frame.min.x + 2 + grab / 2,
                    to = frame.max.x - 2 - grab / 2;
        const auto place = [&](double v) {
            const double share = high > low ? std::clamp((v - low) / (high - low), 0.0, 1.0) : 0.5;
            return std::round(from + (to - from) * static_cast<float>(share));
        };
        const float x = place(value), track = context.px(3), mark = place(standard);
        list.AddRectFilled(frame.min, frame.max,
                           with_alpha(hovered ? theme.field_hovered : theme.field, alpha), rounding);
        if (const bool live = (ImGui::GetItemFlags() & ImGuiItemFlags_Disabled) == 0; live) {
            list.PushClipRect({frame.min.x, frame.max.y - track}, {x, frame.max.y}, true);
            list.AddRectFilled(frame.min, frame.max,
                               with_alpha(theme.accent, (hovered ? 1.0f : 0.75f) * alpha), rounding);
            list.PopClipRect();
            list.AddRectFilled({mark - context.px(1), frame.max.y - track},
                               {mark + context.px(1), frame.max.y + context.px(2)},
                               with_alpha(theme.text_dim, alpha));
            const float half = context.px(2.5f);
            list.AddRectFilled({x - half, frame.max.y - context.px(7)},
                               {x + half, frame.max.y + context.px(1)},
                               with_alpha(hovered ? theme.text : theme.accent, alpha), context.px(2));
        }
        draw_text_in(list, {frame.min, {frame.max.x, frame.max.y - track}}, with_alpha(theme.text, alpha),
                     text, Align::centre);
        if (!ImGui::IsItemActive())
            item_tooltip(tip);
    }
    ImGui::PopID();
    return changed;
}

void switch_row(EditorContext& context, const char* name, Command command, bool standard) {
    const CommandState state = command_state(context, command);
    const KeyBinding& row = binding(command);
    std::string tip = tooltip(command) + "\nDefault: " + (standard ? "on" : "off");
    if (!state.enabled)
        tip += "\nNot now: " + state.reason + ".";
    const bool edited = state.enabled && state.checked != standard;
    row_label(context, row.label, tip, edited, state.enabled);
    ImGui::PushID(name);
    ImGui::BeginDisabled(!state.enabled);
    const RowColumns columns = row_columns(context);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float side = ImGui::GetFrameHeight(), box = std::round(side * 0.72f);
    // The whole control column is the target, not the small box alone.
    if (ImGui::InvisibleButton("box", {columns.control, side}))
        run_command(context, command);
    record_item(name);
    item_tooltip(tip);
    const bool hovered = state.enabled && ImGui::IsItemHovered();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const Theme& theme = context.theme;
    const float alpha = ImGui::GetStyle().Alpha, y = std::round(at.y + (side - box) / 2);
    const Rect square{{at.x, y}, {at.x + box, y + box}};
    list.AddRectFilled(square.min, square.max,
                       with_alpha(state.checked ? theme.accent
                                  : hovered     ? theme.field_hovered
                                                : theme.field,
                                  alpha),
                       context.px(4));
    if (state.checked)
        ImGui::RenderCheckMark(&list, {square.min.x + box * 0.22f, square.min.y + box * 0.22f},
                               with_alpha(theme.on_accent, alpha), box * 0.56f);
    draw_text_in(list, {{square.max.x + context.px(8), at.y}, {at.x + columns.control, at.y + side}},
                 with_alpha(theme.text_faint, alpha), shortcut(command));
    ImGui::EndDisabled();
    ImGui::PopID();
    if (row_reset(context, name, edited, standard ? "on" : "off"))
        run_command(context, command);
}

} // namespace fascicle::editor
