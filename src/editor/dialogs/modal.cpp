#include "editor/dialogs/modal.hpp"

#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/tool_button.hpp"

#include <algorithm>
#include <imgui_internal.h>

namespace fascicle::editor {

namespace {

constexpr float button_width = 124, button_gap = 8;

} // namespace

bool begin_modal(const EditorContext& context, const char* title, bool& appears, float width, float height,
                 bool* keep) {
    if (appears && ImGui::GetTopMostPopupModal() == nullptr) { // one question after the other
        ImGui::OpenPopup(title);
        appears = false;
    }
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowSize({std::min(window.x * 0.94f, context.px(width)),
                              height == 0 ? 0 : std::min(window.y * 0.92f, context.px(height))});
    ImGui::SetNextWindowPos({window.x / 2, window.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    return ImGui::BeginPopupModal(
        title, keep, ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings);
}

void wrapped_text(ImU32 colour, const std::string& text) {
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
}

void button_row(const EditorContext& context, int count) {
    const auto n = static_cast<float>(count);
    const float width = n * context.px(button_width) + (n - 1) * context.px(button_gap);
    ImGui::Dummy({1, context.px(4)});
    ImGui::SetCursorPosX(
        std::max(ImGui::GetCursorPosX(), ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x - width));
}

bool row_button(const EditorContext& context, const char* name, const char* label, const char* tip,
                ButtonKind kind, const std::string& why_not) {
    ImGui::BeginDisabled(!why_not.empty());
    if (kind == ButtonKind::primary)
        ImGui::PushStyleColor(ImGuiCol_Button, context.theme.accent_dim);
    ImGui::PushID(name);
    const bool clicked = ImGui::Button(label, {context.px(button_width), 0});
    ImGui::PopID();
    if (kind == ButtonKind::primary)
        ImGui::PopStyleColor();
    record_item(name);
    ImGui::EndDisabled();
    item_tooltip(why_not.empty() ? tip : why_not);
    ImGui::SameLine(0, context.px(button_gap));
    return clicked && why_not.empty();
}

} // namespace fascicle::editor
