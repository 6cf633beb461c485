#include "editor/dialogs/reload_dialog.hpp"

#include "editor/dialogs/modal.hpp"
#include "editor/features.hpp"

namespace fascicle::editor {

namespace fs = std::filesystem;

void ReloadDialog::ask(std::vector<std::string> sources, const fs::path& project) {
    sources_ = std::move(sources);
    project_ = project;
    appears_ = true;
}

void ReloadDialog::draw(EditorContext& context) {
    if (!begin_modal(context, "Changed on disk", appears_, 500, 0))
        return;
    const bool whole = !project_.empty();
    std::vector<std::string> names;
    if (whole)
        names.push_back(project_.filename().string());
    for (const std::string& source : sources_)
        names.push_back(fs::path(source).filename().string());
    wrapped_text(context.theme.text, names.size() == 1 ? "Another program has changed " + names[0] + "."
                                                       : "Other programs have changed files of this scene:");
    for (std::size_t i = 0; names.size() > 1 && i < names.size() && i < 8; ++i)
        wrapped_text(context.theme.text, "   " + names[i]);
    if (names.size() > 8)
        wrapped_text(context.theme.text_dim, "   and " + std::to_string(names.size() - 8) + " more");
    const bool loses = whole && context.document.dirty();
    wrapped_text(loses ? context.theme.warning : context.theme.text_dim,
                 loses   ? "Opening it again loses your unsaved changes."
                 : whole ? "It can be opened again."
                         : "They can be read again; that is one undo step.");
    button_row(context, 2);
    const bool keep = row_button(context, "reload/keep", "Keep what is here",
                                 "Goes on with what is in memory; saving carries such meshes inside (Esc)");
    const bool reload = row_button(context, "reload/reload", whole ? "Open again" : "Reload",
                                   "Reads the files as they are now", ButtonKind::primary);
    if (keep || reload)
        ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
    if (reload && whole)
        context.features.opener.open_project(project_);
    else if (reload)
        context.features.watch.reload(context, sources_);
}

} // namespace fascicle::editor
