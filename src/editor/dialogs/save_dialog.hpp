#pragma once
// Asks where a project is to be saved, and again when it cannot be written there.

#include "editor/dialogs/dialog.hpp"
#include "editor/project/project_flow.hpp"
#include "editor/widgets/file_browser.hpp"

namespace fascicle::editor {

class SaveDialog : public Dialog {
public:
    SaveDialog();
    void open(const std::filesystem::path& suggestion, bool carry_meshes, Then then);
    /// It could not be written: says why and offers another name.
    void failed(const std::filesystem::path& path, const std::string& reason, bool carry_meshes, Then then);
    void draw(EditorContext& context) override;
    void close() override { then_ = nullptr; }

private:
    std::filesystem::path target() const;
    void draw_file(EditorContext& context, ImVec2 size);
    FileBrowser browser_;
    std::string name_, problem_;
    std::filesystem::path agreed_; ///< the existing file whose replacing has been warned of
    Then then_;
    bool carry_meshes_ = false, appears_ = false, focus_name_ = false, entered_ = false;
};

} // namespace fascicle::editor
