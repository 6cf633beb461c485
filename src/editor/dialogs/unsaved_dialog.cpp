#include "editor/dialogs/unsaved_dialog.hpp"

#include "editor/dialogs/modal.hpp"

#include <utility>

namespace fascicle::editor {

void UnsavedDialog::ask(const std::string& doing, Then then) {
    doing_ = doing;
    then_ = std::move(then);
    appears_ = true;
}

void UnsavedDialog::draw(EditorContext& context) {
    if (!begin_modal(context, "Unsaved changes", appears_, 470, 0))
        return;
    const std::string name = context.document.path().empty() ? context.document.scene().name
                                                             : context.document.path().filename().string();
    wrapped_text(context.theme.text, "Save the changes to " + name + " before " + doing_ + "?");
    wrapped_text(context.theme.text_dim, "Changes that are not saved are lost.");
    enum { none, cancel, discard, save } choice = none;
    button_row(context, 3);
    if (row_button(context, "unsaved/cancel", "Cancel", "Leaves everything as it is (Esc)"))
        choice = cancel;
    if (row_button(context, "unsaved/discard", "Discard changes", "Goes on without saving"))
        choice = discard;
    if (row_button(context, "unsaved/save", "Save", "Saves, then goes on", ButtonKind::primary))
        choice = save;
    if (choice != none)
        ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
    const Then then = choice == none ? nullptr : std::exchange(then_, nullptr);
    if (choice == discard && then)
        then(context);
    if (choice == save)
        save_project(context, [doing = doing_, then](EditorContext& c) { unless_unsaved(c, doing, then); });
}

} // namespace fascicle::editor
