#pragma once
// Asks under which name the picture of the view is to be written.

#include "editor/editor_context.hpp"

namespace fascicle::editor {

class PictureDialog {
public:
    void open(const std::filesystem::path& suggestion);
    /// Once a frame. The wish goes to EditorState::wants_picture.
    void draw(EditorContext& context);

private:
    std::string name_;
    bool appears_ = false;
};

/// "hip_060.png" in the current folder, with a number behind it when that exists already.
std::filesystem::path next_picture_name(const std::string& scene, int frame);

} // namespace fascicle::editor
