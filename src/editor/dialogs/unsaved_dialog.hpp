#pragma once
// Asks what is to happen to unsaved changes before they would be lost.

#include "editor/dialogs/dialog.hpp"
#include "editor/project/project_flow.hpp"

namespace fascicle::editor {

class UnsavedDialog : public Dialog {
public:
    /// doing: "closing the program". `then`: once the changes are saved, or are not wanted.
    void ask(const std::string& doing, Then then);
    void draw(EditorContext& context) override;
    void close() override { then_ = nullptr; }

private:
    std::string doing_;
    Then then_;
    bool appears_ = false;
};

} // namespace fascicle::editor
