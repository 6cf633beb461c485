#include "editor/dialogs/open_project_dialog.hpp"

#include "editor/dialogs/modal.hpp"
#include "editor/project/project_flow.hpp"

namespace fascicle::editor {

namespace fs = std::filesystem;

OpenProjectDialog::OpenProjectDialog() : browser_({".fascicle"}, "No projects here") {}

void OpenProjectDialog::open(const fs::path& near) {
    std::error_code error;
    browser_.go_to(near.empty() ? browser_.folder() : fs::absolute(near, error).parent_path());
    appears_ = true;
}

void OpenProjectDialog::draw(EditorContext& context) {
    if (!begin_modal(context, "Open project", appears_, 680, 480))
        return;
    const ImVec2 room = ImGui::GetContentRegionAvail();
    browser_.draw(context, {room.x, room.y - ImGui::GetFrameHeightWithSpacing() - context.px(12)});
    const fs::path chosen = browser_.chosen();
    button_row(context, 2);
    const bool cancel = row_button(context, "open_project/cancel", "Cancel", "Opens nothing (Esc)");
    const bool open =
        row_button(context, "open_project/open", "Open", "Opens the project in place of this scene",
                   ButtonKind::primary, chosen.empty() ? "Choose a project first." : "") ||
        (!chosen.empty() && browser_.confirmed());
    if (cancel || open)
        ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
    if (open)
        open_project(context, chosen);
}

} // namespace fascicle::editor
