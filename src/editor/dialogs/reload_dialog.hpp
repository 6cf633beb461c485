#pragma once
// Offers to read files again that another program has changed.

#include "editor/dialogs/dialog.hpp"

namespace fascicle::editor {

class ReloadDialog : public Dialog {
public:
    /// sources: files of the scene; project: the project's own file when that has changed too, else empty.
    void ask(std::vector<std::string> sources, const std::filesystem::path& project);
    void draw(EditorContext& context) override;

private:
    std::vector<std::string> sources_;
    std::filesystem::path project_;
    bool appears_ = false;
};

} // namespace fascicle::editor
