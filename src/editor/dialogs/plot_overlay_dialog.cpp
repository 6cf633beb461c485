#include "editor/dialogs/plot_overlay_dialog.hpp"

#include "editor/features.hpp"
#include "editor/widgets/item_recorder.hpp"

namespace fascicle::editor {

void PlotOverlayDialog::open(const std::string& plot) {
    plot_ = plot;
    open_ = appears_ = true;
    browser_.go_to(browser_.chosen().empty() ? std::filesystem::path(".") : browser_.chosen().parent_path());
}

void PlotOverlayDialog::draw(EditorContext& context) {
    if (std::exchange(appears_, false))
        ImGui::OpenPopup("Overlay a CSV");
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowSize({std::min(window.x * 0.94f, context.px(560)), 0});
    ImGui::SetNextWindowPos({window.x / 2, window.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    if (!ImGui::BeginPopupModal("Overlay a CSV", &open_,
                                ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                    ImGuiWindowFlags_NoSavedSettings))
        return;
    const float width = ImGui::GetContentRegionAvail().x;
    ImGui::PushStyleColor(ImGuiCol_Text, context.theme.text_dim);
    ImGui::TextWrapped(
        "First column: frame, time_s or angle_deg. Each further column becomes a dashed curve in the "
        "plot's unit.");
    ImGui::PopStyleColor();
    browser_.draw(context, {width, std::min(context.px(280), window.y * 0.5f)});
    const float button = context.px(110);
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + width - 2 * button - context.px(8));
    if (ImGui::Button("Cancel", {button, 0}))
        open_ = false;
    record_item("plot_overlay/cancel");
    ImGui::SameLine(0, context.px(8));
    const bool ready = !browser_.chosen().empty();
    ImGui::BeginDisabled(!ready);
    ImGui::PushStyleColor(ImGuiCol_Button, context.theme.accent_dim);
    const bool take = ImGui::Button("Overlay", {button, 0}) || (ready && browser_.confirmed());
    ImGui::PopStyleColor();
    ImGui::EndDisabled();
    record_item("plot_overlay/take");
    if (take && ready) {
        context.features.plots.read_overlay(browser_.chosen(), plot_);
        open_ = false;
    }
    if (!open_)
        ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

} // namespace fascicle::editor
