#include "editor/dialogs/pick_file_dialog.hpp"

#include "editor/widgets/item_recorder.hpp"

namespace fascicle::editor {

void PickFileDialog::open(std::string title, std::vector<std::string> extensions, std::string button,
                          Use use) {
    title_ = std::move(title);
    button_ = std::move(button);
    use_ = std::move(use);
    browser_.emplace(std::move(extensions));
    problem_.clear();
    open_ = appears_ = true;
}

void PickFileDialog::go_to(const std::filesystem::path& path) {
    if (browser_)
        browser_->go_to(path);
}

void PickFileDialog::use(EditorContext& context) {
    try {
        use_(context, browser_->chosen());
        open_ = false;
    } catch (const std::exception& problem) {
        problem_ = problem.what();
        context.log.add(Severity::error, problem_);
    }
}

void PickFileDialog::draw(EditorContext& context) {
    if (!open_)
        return;
    if (appears_) {
        ImGui::OpenPopup(title_.c_str());
        appears_ = false;
    }
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowSize(
        {std::min(window.x * 0.94f, context.px(560)), std::min(window.y * 0.92f, context.px(460))});
    ImGui::SetNextWindowPos({window.x / 2, window.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    bool keep = true;
    if (!ImGui::BeginPopupModal(title_.c_str(), &keep,
                                ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                    ImGuiWindowFlags_NoSavedSettings)) {
        open_ = false; // Esc closed it
        return;
    }
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const float line = ImGui::GetTextLineHeightWithSpacing();
    const float foot = ImGui::GetFrameHeight() + 2 * line + context.px(14);
    ImGui::BeginGroup();
    if (browser_->draw(context, {room.x, room.y - foot}))
        problem_.clear();
    ImGui::EndGroup();
    if (browser_->confirmed())
        use(context);
    ImGui::Dummy({1, context.px(2)});
    const float text_top = ImGui::GetCursorPosY();
    ImGui::PushTextWrapPos(0);
    ImGui::PushStyleColor(ImGuiCol_Text, context.theme.bad);
    ImGui::TextUnformatted(problem_.c_str());
    if (!problem_.empty())
        record_item("pick/problem");
    ImGui::PopStyleColor();
    ImGui::PopTextWrapPos();
    const float button = context.px(110);
    ImGui::SetCursorPos(
        {ImGui::GetCursorStartPos().x + room.x - 2 * button - context.px(8), text_top + 2 * line});
    if (ImGui::Button("Cancel", {button, 0}))
        keep = false;
    record_item("pick/cancel");
    ImGui::SameLine(0, context.px(8));
    ImGui::BeginDisabled(browser_->chosen().empty());
    ImGui::PushStyleColor(ImGuiCol_Button, context.theme.accent_dim);
    if (ImGui::Button(button_.c_str(), {button, 0}))
        use(context);
    ImGui::PopStyleColor();
    record_item("pick/ok");
    ImGui::EndDisabled();
    if (!keep)
        open_ = false;
    if (!open_)
        ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

} // namespace fascicle::editor
