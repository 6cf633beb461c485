#pragma once
// Chooses the folder of a run, to compare with.

#include "editor/dialogs/dialog.hpp"
#include "editor/widgets/file_browser.hpp"

namespace fascicle::editor {

class RunDialog : public Dialog {
public:
    RunDialog();

    void open();
    bool is_open() const { return open_; }
    void close() override { open_ = false; }
    void draw(EditorContext& context) override;

private:
    FileBrowser browser_;
    bool open_ = false, appears_ = false;
};

} // namespace fascicle::editor
