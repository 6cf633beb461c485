#include "editor/dialogs/recovery_dialog.hpp"

#include "editor/dialogs/modal.hpp"
#include "editor/features.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/paint.hpp"

#include <ctime>

namespace fascicle::editor {

namespace {

constexpr float picture_width = 144, picture_height = 90, row_gap = 12;

} // namespace

std::string time_text(std::int64_t seconds) {
    const auto time = static_cast<std::time_t>(seconds);
    std::tm local = {};
    char text[64];
    static constexpr const char* months[] = {"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                             "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
    if (::localtime_r(&time, &local) == nullptr)
        return {};
    std::snprintf(text, sizeof text, "%d %s %d, %02d:%02d", local.tm_mday,
                  months[static_cast<std::size_t>(local.tm_mon) % 12], local.tm_year + 1900, local.tm_hour,
                  local.tm_min);
    return text;
}

void RecoveryDialog::ask(std::vector<AutosaveSession> sessions) {
    rows_.clear();
    for (AutosaveSession& session : sessions)
        rows_.push_back({std::move(session), {}});
    appears_ = true;
}

RecoveryDialog::Choice RecoveryDialog::draw_row(EditorContext& context, Row& row, std::size_t index) {
    const AutosaveSession& session = row.session;
    const std::string id = "recovery/" + std::to_string(index);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const ImVec2 size{context.px(picture_width), context.px(picture_height)};
    row.picture.load(context, session.picture);
    row.picture.draw(context, {at, {at.x + size.x, at.y + size.y}});
    ImGui::Dummy(size);
    record_item(id);
    ImGui::SameLine(0, context.px(14));
    ImGui::BeginGroup();
    const float width = ImGui::GetContentRegionAvail().x;
    const auto line = [&](ImU32 colour, const std::string& text) {
        ImGui::PushStyleColor(ImGuiCol_Text, colour);
        ImGui::TextUnformatted(elided(text, width).c_str());
        ImGui::PopStyleColor();
    };
    line(context.theme.text, session.name);
    line(context.theme.text_dim, "kept " + time_text(session.time));
    line(context.theme.text_faint,
         session.project.empty() ? "never saved" : "of " + session.project.string());
    ImGui::SetCursorScreenPos({ImGui::GetCursorScreenPos().x, at.y + size.y - ImGui::GetFrameHeight()});
    Choice choice = Choice::none;
    const auto button = [&](const char* name, const char* label, const char* tip, ButtonKind kind,
                            Choice means) {
        if (row_button(context, (id + name).c_str(), label, tip, kind))
            choice = means;
    };
    button("/restore", "Restore", "Opens it as it was; your file stays until you save", ButtonKind::primary,
           Choice::restore);
    button("/later", "Keep for later", "Asks again at the next start (Esc: all of them)", ButtonKind::plain,
           Choice::later);
    button("/delete", "Delete", "Removes these copies for good; your file stays", ButtonKind::plain,
           Choice::remove);
    ImGui::NewLine();
    ImGui::EndGroup();
    return choice;
}

void RecoveryDialog::draw(EditorContext& context) {
    if (rows_.empty())
        return;
    const auto shown = static_cast<float>(std::min<std::size_t>(rows_.size(), 3));
    if (!begin_modal(context, "Unsaved work was found", appears_, 620,
                     112 + shown * (picture_height + row_gap)))
        return;
    wrapped_text(context.theme.text_dim, "The program ended without saving. What do you want to do with it?");
    ImGui::Dummy({1, context.px(4)});
    Choice choice = Choice::none;
    std::size_t chosen = 0;
    if (ImGui::BeginChild("sessions"))
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            if (const Choice one = draw_row(context, rows_[i], i); one != Choice::none) {
                choice = one;
                chosen = i;
            }
            ImGui::Dummy({1, context.px(row_gap) - ImGui::GetStyle().ItemSpacing.y});
        }
    ImGui::EndChild();
    if (choice == Choice::restore || (choice != Choice::none && rows_.size() == 1))
        ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
    if (choice == Choice::none)
        return;
    const AutosaveSession session = rows_[chosen].session;
    rows_.erase(rows_.begin() + static_cast<std::ptrdiff_t>(chosen));
    if (choice == Choice::remove)
        remove_autosaves(session);
    if (choice == Choice::restore) { // the others are asked about at the next start
        rows_.clear();
        unless_unsaved(context, "restoring " + session.name, [session](EditorContext& c) {
            c.features.opener.recover(session.file, session.project);
        });
    }
}

} // namespace fascicle::editor
