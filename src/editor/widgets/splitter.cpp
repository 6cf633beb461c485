#include "editor/widgets/splitter.hpp"

#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/paint.hpp"

namespace fascicle::editor {

float splitter(const char* id, const Rect& line, SplitAxis axis, float scale) {
    const bool vertical = axis == SplitAxis::x;
    const float reach = 3.0f * scale;
    const ImVec2 low =
        vertical ? ImVec2(line.min.x - reach, line.min.y) : ImVec2(line.min.x, line.min.y - reach);
    const ImVec2 high =
        vertical ? ImVec2(line.max.x + reach, line.max.y) : ImVec2(line.max.x, line.max.y + reach);
    ImGui::SetNextWindowPos(low);
    ImGui::SetNextWindowSize({high.x - low.x, high.y - low.y});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
    float moved = 0;
    if (ImGui::Begin(id, nullptr,
                     ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoBackground |
                         ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus |
                         ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav)) {
        ImGui::InvisibleButton("handle", {high.x - low.x, high.y - low.y});
        record_item(id);
        const bool active = ImGui::IsItemActive();
        if (active || ImGui::IsItemHovered()) {
            ImGui::SetMouseCursor(vertical ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
            const ImU32 colour =
                ImGui::GetColorU32(active ? ImGuiCol_SeparatorActive : ImGuiCol_SeparatorHovered);
            ImGui::GetWindowDrawList()->AddRectFilled(line.min, line.max, colour);
        }
        if (active)
            moved = vertical ? ImGui::GetIO().MouseDelta.x : ImGui::GetIO().MouseDelta.y;
    }
    ImGui::End();
    ImGui::PopStyleVar(2);
    return moved;
}

} // namespace fascicle::editor
