#pragma once
// Asks where the files are that a project names and that are not there any more.

#include "editor/dialogs/dialog.hpp"
#include "editor/scene_opener.hpp"
#include "editor/widgets/file_browser.hpp"

namespace fascicle::editor {

class LocateDialog : public Dialog {
public:
    LocateDialog();
    void ask(MissingFiles missing);
    /// Also asks on its own when the opener has found files missing.
    void draw(EditorContext& context) override;

private:
    void draw_list(EditorContext& context, ImVec2 size);
    void choose(const std::filesystem::path& file);
    void open(EditorContext& context);
    FileBrowser browser_;
    MissingFiles missing_;
    std::size_t selected_ = 0;
    bool appears_ = false;
};

} // namespace fascicle::editor
