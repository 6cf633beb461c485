#include "editor/dialogs/locate_dialog.hpp"

#include "editor/dialogs/modal.hpp"
#include "editor/features.hpp"
#include "editor/widgets/icons.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/paint.hpp"
#include "editor/widgets/tool_button.hpp"
#include "fascicle/io/format_registry.hpp"

namespace fascicle::editor {

namespace fs = std::filesystem;

namespace {

/// What a project may refer to.
std::vector<std::string> extensions() {
    std::vector<std::string> all = mesh_extensions();
    all.insert(all.end(), {".csv", ".json", ".osim", ".mot", ".sto"});
    return all;
}

} // namespace

LocateDialog::LocateDialog() : browser_(extensions(), "No meshes here") {}

void LocateDialog::ask(MissingFiles missing) {
    missing_ = std::move(missing);
    selected_ = 0;
    std::error_code error;
    fs::path folder = missing_.files[0].path.parent_path(); // as near as there still is something
    while (!fs::is_directory(folder, error) && folder.has_relative_path())
        folder = folder.parent_path();
    browser_.go_to(folder);
    appears_ = true;
}

/// The file for the selected line; others of the list that lie beside it are found with it.
void LocateDialog::choose(const fs::path& file) {
    if (file.empty() || selected_ >= missing_.files.size())
        return;
    missing_.located[missing_.files[selected_].path] = file;
    std::error_code error;
    for (const MissingFile& other : missing_.files)
        if (const fs::path guess = file.parent_path() / other.path.filename();
            missing_.located.count(other.path) == 0 && fs::is_regular_file(guess, error))
            missing_.located[other.path] = guess;
    for (std::size_t i = 0; i < missing_.files.size(); ++i)
        if (missing_.located.count(missing_.files[i].path) == 0) {
            selected_ = i;
            return;
        }
}

void LocateDialog::draw_list(EditorContext& context, ImVec2 size) {
    ImGui::PushStyleColor(ImGuiCol_ChildBg, context.theme.plot);
    if (ImGui::BeginChild("missing", size)) {
        ImDrawList& list = *ImGui::GetWindowDrawList();
        for (std::size_t i = 0; i < missing_.files.size(); ++i) {
            const MissingFile& file = missing_.files[i];
            const auto found = missing_.located.find(file.path);
            const bool known = found != missing_.located.end();
            const ImVec2 at = ImGui::GetCursorScreenPos();
            const float width = ImGui::GetContentRegionAvail().x, height = context.px(44);
            ImGui::PushID(static_cast<int>(i));
            if (ImGui::Selectable("##file", i == selected_, 0, {width, height}))
                selected_ = i;
            ImGui::PopID();
            record_item("locate/file/" + file.path.filename().string());
            item_tooltip(known ? found->second.string() : file.path.string());
            const float x = at.x + context.px(10), right = at.x + width - context.px(10),
                        middle = at.y + height / 2;
            draw_text_in(list, {{x, at.y}, {x + context.px(20), at.y + height}},
                         known ? context.theme.good : context.theme.warning,
                         text(known ? icons::check : icons::warning));
            draw_text_in(list, {{x + context.px(26), at.y + context.px(3)}, {right, middle}},
                         context.theme.text, file.path.filename().string() + "  (" + file.what + ")");
            draw_text_in(list, {{x + context.px(26), middle}, {right, at.y + height - context.px(3)}},
                         context.theme.text_faint,
                         known ? "found: " + found->second.string()
                               : "was in " + file.path.parent_path().string());
        }
    }
    ImGui::EndChild();
    ImGui::PopStyleColor();
}

void LocateDialog::open(EditorContext& context) {
    if (missing_.recovered)
        context.features.opener.recover(missing_.project, missing_.user_path, std::move(missing_.located));
    else
        context.features.opener.open_project(missing_.project, std::move(missing_.located));
}

void LocateDialog::draw(EditorContext& context) {
    if (std::optional<MissingFiles> more = context.features.opener.take_missing())
        ask(std::move(*more));
    if (!begin_modal(context, "Locate files", appears_, 760, 560))
        return;
    const ImVec2 room = ImGui::GetContentRegionAvail();
    std::size_t open_questions = 0;
    for (const MissingFile& file : missing_.files)
        open_questions += missing_.located.count(file.path) == 0 ? 1 : 0;
    const fs::path& shown = missing_.recovered ? missing_.user_path : missing_.project;
    wrapped_text(context.theme.text,
                 (shown.empty() ? "The project" : shown.filename().string()) +
                     " needs files that are not where they were. Show where they are now.");
    const float foot = ImGui::GetFrameHeightWithSpacing() + context.px(14);
    const float list = std::min(context.px(50) * static_cast<float>(missing_.files.size()), room.y * 0.35f);
    draw_list(context, {room.x, list});
    ImGui::Dummy({1, context.px(2)});
    if (browser_.draw(context, {room.x, ImGui::GetContentRegionAvail().y - foot}))
        choose(browser_.chosen());
    button_row(context, 2);
    const bool cancel = row_button(context, "locate/cancel", "Cancel", "Opens nothing (Esc)");
    const std::string why_not =
        open_questions == 0 ? "" : std::to_string(open_questions) + " still to be found";
    const bool go = row_button(context, "locate/open", "Open", "Opens the project with these files",
                               ButtonKind::primary, why_not);
    if (cancel || go)
        ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
    if (go)
        open(context);
}

} // namespace fascicle::editor
