#include "editor/dialogs/run_dialog.hpp"

#include "editor/dialogs/modal.hpp"
#include "editor/features.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/tool_button.hpp"
#include "fascicle/io/run_reader.hpp"

namespace fascicle::editor {

namespace fs = std::filesystem;

namespace {
constexpr const char* popup_name = "Load a run folder";
}

RunDialog::RunDialog() : browser_({".json"}, "No folders and no summary.json here") {}

void RunDialog::open() {
    open_ = appears_ = true;
    browser_.go_to(browser_.folder()); // what is there now
}

void RunDialog::draw(EditorContext& context) {
    if (!open_)
        return;
    bool keep = true;
    const bool opening = appears_;
    if (!begin_modal(context, popup_name, appears_, 620, 460, &keep)) {
        if (opening)
            return;    // another one is in front
        open_ = false; // Esc closed it
        return;
    }
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const float line = ImGui::GetFrameHeight(), gap = context.px(6);
    browser_.draw(context, {room.x, room.y - 2 * line - 3 * gap});
    const fs::path file = browser_.chosen();
    const fs::path folder = file.empty() ? browser_.folder() : file.parent_path();
    const bool ready = is_run_folder(folder);
    ImGui::Dummy({1, gap / 2});
    ImGui::PushStyleColor(ImGuiCol_Text, ready ? context.theme.text_dim : context.theme.text_faint);
    ImGui::TextUnformatted(
        ready ? ("Run " + folder.filename().string()).c_str()
              : "Open a folder that 'fascicle simulate --export vtp' left: it holds a summary.json.");
    ImGui::PopStyleColor();
    const float button = context.px(110);
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + room.x - 2 * button - context.px(8));
    if (ImGui::Button("Cancel", {button, 0}))
        keep = false;
    record_item("run/cancel");
    ImGui::SameLine(0, context.px(8));
    ImGui::BeginDisabled(!ready);
    ImGui::PushStyleColor(ImGuiCol_Button, context.theme.accent_dim);
    const bool load = ImGui::Button("Load", {button, 0}) || (ready && browser_.confirmed());
    ImGui::PopStyleColor();
    record_item("run/load");
    ImGui::EndDisabled();
    item_tooltip(ready ? "Reads all frames; it is kept until it is deleted."
                       : "Not now: this folder holds no run.");
    if (load && ready) {
        context.features.shelf.load(folder);
        context.state.side_panel = "compare";
        keep = false;
    }
    if (!keep) {
        open_ = false;
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
}

} // namespace fascicle::editor
