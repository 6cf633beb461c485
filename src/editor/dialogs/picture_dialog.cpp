#include "editor/dialogs/picture_dialog.hpp"

#include "editor/widgets/item_recorder.hpp"

#include <cctype>
#include <cstdio>
#include <imgui_stdlib.h>

namespace fascicle::editor {

namespace fs = std::filesystem;

fs::path next_picture_name(const std::string& scene, int frame) {
    std::string stem;
    for (const char c : scene) // a name that every file system takes
        stem += std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' ? c : '_';
    char number[20];
    std::snprintf(number, sizeof number, "_%03d", frame);
    stem = (stem.empty() ? "scene" : stem) + number;
    fs::path path = stem + ".png";
    std::error_code error;
    for (int k = 2; fs::exists(path, error) && k < 10000; ++k)
        path = stem + "_" + std::to_string(k) + ".png";
    return path;
}

void PictureDialog::open(const fs::path& suggestion) {
    std::error_code error;
    name_ = fs::absolute(suggestion, error).string();
    appears_ = true;
}

void PictureDialog::draw(EditorContext& context) {
    if (appears_) {
        ImGui::OpenPopup("Save picture");
        appears_ = false;
    }
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowSize({std::min(window.x * 0.94f, context.px(520)), 0});
    ImGui::SetNextWindowPos({window.x / 2, window.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    bool keep = true;
    if (!ImGui::BeginPopupModal("Save picture", &keep,
                                ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                    ImGuiWindowFlags_NoSavedSettings))
        return;
    const float width = ImGui::GetContentRegionAvail().x;
    ImGui::SetNextItemWidth(width);
    const bool entered = ImGui::InputText("##file", &name_, ImGuiInputTextFlags_EnterReturnsTrue);
    record_item("picture/file");
    fs::path path = name_;
    if (path.extension() != ".png")
        path += ".png";
    std::error_code error;
    const bool exists = fs::exists(path, error);
    ImGui::PushStyleColor(ImGuiCol_Text, exists ? context.theme.warning : context.theme.text_faint);
    ImGui::TextUnformatted(exists ? "This file exists and will be replaced."
                                  : "The view as a PNG, at its size on the screen.");
    ImGui::PopStyleColor();
    ImGui::Dummy({1, context.px(4)});
    const float button = context.px(110);
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + width - 2 * button - context.px(8));
    if (ImGui::Button("Cancel", {button, 0}))
        keep = false;
    record_item("picture/cancel");
    ImGui::SameLine(0, context.px(8));
    ImGui::PushStyleColor(ImGuiCol_Button, context.theme.accent_dim);
    const bool write = ImGui::Button("Write", {button, 0}) || entered;
    ImGui::PopStyleColor();
    record_item("picture/write");
    if (write && !name_.empty()) {
        context.state.wants_picture = path;
        keep = false;
    }
    if (!keep)
        ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

} // namespace fascicle::editor
