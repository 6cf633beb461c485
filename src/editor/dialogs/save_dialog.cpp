#include "editor/dialogs/save_dialog.hpp"

#include "editor/dialogs/modal.hpp"
#include "editor/features.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/tool_button.hpp"

#include <imgui_stdlib.h>
#include <utility>

namespace fascicle::editor {

namespace fs = std::filesystem;

SaveDialog::SaveDialog() : browser_({".fascicle"}, "No projects here") {}

void SaveDialog::open(const fs::path& suggestion, bool carry_meshes, Then then) {
    std::error_code error;
    const fs::path full = fs::absolute(suggestion, error);
    browser_.go_to(full.parent_path());
    name_ = full.filename().string();
    carry_meshes_ = carry_meshes;
    problem_.clear();
    agreed_.clear();
    then_ = std::move(then);
    appears_ = focus_name_ = true;
}

void SaveDialog::failed(const fs::path& path, const std::string& reason, bool carry_meshes, Then then) {
    open(path, carry_meshes, std::move(then));
    problem_ = reason;
}

fs::path SaveDialog::target() const {
    fs::path name = name_;
    if (name.extension() != ".fascicle")
        name += ".fascicle";
    return browser_.folder() / name; // an absolute name stands for itself
}

void SaveDialog::draw_file(EditorContext& context, ImVec2 size) {
    ImGui::AlignTextToFramePadding();
    ImGui::PushStyleColor(ImGuiCol_Text, context.theme.text_dim);
    ImGui::TextUnformatted("Name");
    ImGui::PopStyleColor();
    ImGui::SameLine(0, context.px(10));
    ImGui::SetNextItemWidth(size.x - (ImGui::GetCursorPosX() - ImGui::GetWindowContentRegionMin().x));
    if (std::exchange(focus_name_, false))
        ImGui::SetKeyboardFocusHere();
    entered_ = ImGui::InputText("##name", &name_, ImGuiInputTextFlags_EnterReturnsTrue);
    record_item("save/name");
    item_tooltip("Name of the file; .fascicle is added when it is missing");
    ImGui::Checkbox("Carry the meshes inside", &carry_meshes_);
    record_item("save/carry");
    item_tooltip(
        "On: the project is one file that can be sent to anybody, and is larger.\n"
        "Off: it refers to the mesh files where they are. Meshes that are in no file are always inside.\n"
        "Default: off");
}

void SaveDialog::draw(EditorContext& context) {
    if (!begin_modal(context, "Save project", appears_, 680, 520))
        return;
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const float line = ImGui::GetFrameHeightWithSpacing();
    const float text = ImGui::CalcTextSize(problem_.c_str(), nullptr, false, room.x).y;
    const float foot =
        3 * line + context.px(26) + ImGui::GetTextLineHeight() + (problem_.empty() ? 0 : 2 * text);
    if (browser_.draw(context, {room.x, std::max(context.px(80), room.y - foot)}))
        name_ = browser_.chosen().filename().string();
    ImGui::Dummy({1, context.px(2)});
    draw_file(context, room);
    const fs::path path = target();
    std::error_code error;
    const bool named = !fs::path(name_).stem().empty() && name_ != ".fascicle";
    const bool exists = named && fs::exists(path, error) && path != context.document.path();
    if (!problem_.empty())
        wrapped_text(context.theme.bad, problem_ + "\nNothing is lost: choose another name or folder.");
    else
        wrapped_text(exists ? context.theme.warning : context.theme.text_faint,
                     exists ? path.filename().string() + " exists and will be replaced."
                            : "Everything but results of runs is saved; the undo list stays.");
    button_row(context, 2);
    const bool cancel = row_button(context, "save/cancel", "Cancel", "Saves nothing (Esc)");
    const std::string why_not = named ? "" : "Give the file a name first.";
    bool save = row_button(context, "save/save", exists ? "Replace" : "Save", "Writes the file (Enter)",
                           ButtonKind::primary, why_not);
    // Enter on a file that exists only shows the warning; a second Enter (or the button) replaces it.
    if ((entered_ || browser_.confirmed()) && named) {
        save |= !exists || agreed_ == path;
        agreed_ = path;
    }
    if (cancel || save)
        ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
    if (cancel)
        then_ = nullptr;
    if (save)
        context.features.project.save(context, path, carry_meshes_, std::exchange(then_, nullptr));
}

} // namespace fascicle::editor
