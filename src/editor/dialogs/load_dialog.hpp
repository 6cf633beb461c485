#pragma once
// Chooses a file that is no mesh: attachment outlines, surface fibres, a fibre template, a model, a motion.

#include "editor/dialogs/dialog.hpp"
#include "editor/dropped_file.hpp"
#include "editor/widgets/file_browser.hpp"

namespace fascicle::editor {

class LoadDialog : public Dialog {
public:
    /// What there is to load; polylines are of kind `mesh`.
    void open(FileKind kind);
    bool is_open() const { return kind_ != FileKind::unknown; }
    void close() override;
    void draw(EditorContext& context) override;

private:
    void draw_muscle(EditorContext& context);
    void load(EditorContext& context);

    FileKind kind_ = FileKind::unknown;
    bool appears_ = false;
    std::optional<FileBrowser> browser_;
    std::filesystem::path folder_; ///< where the last file was
};

} // namespace fascicle::editor
