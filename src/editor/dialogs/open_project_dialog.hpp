#pragma once
// Asks which project is to be opened.

#include "editor/dialogs/dialog.hpp"
#include "editor/widgets/file_browser.hpp"

namespace fascicle::editor {

class OpenProjectDialog : public Dialog {
public:
    OpenProjectDialog();
    /// near: a file in whose folder it begins; empty: where it was last.
    void open(const std::filesystem::path& near);
    void draw(EditorContext& context) override;

private:
    FileBrowser browser_;
    bool appears_ = false;
};

} // namespace fascicle::editor
