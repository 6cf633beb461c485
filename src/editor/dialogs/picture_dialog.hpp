#pragma once
// Asks under which name the picture of the view is to be written.

#include "editor/dialogs/dialog.hpp"

namespace fascicle::editor {

class PictureDialog : public Dialog {
public:
    void open(const std::filesystem::path& suggestion);
    /// The wish goes to EditorState::wants_picture.
    void draw(EditorContext& context) override;

private:
    std::string name_;
    bool appears_ = false;
};

/// "hip_060.png" in the current folder, with a number behind it when that exists already.
std::filesystem::path next_picture_name(const std::string& scene, int frame);

} // namespace fascicle::editor
