#pragma once
// Folders and files to choose from, on std::filesystem alone.

#include "editor/editor_context.hpp"

namespace fascicle::editor {

class FileBrowser {
public:
    /// extensions: lower case with the dot; only such files are listed. Starts in the current folder.
    /// empty_text: shown for a folder without any.
    explicit FileBrowser(std::vector<std::string> extensions, std::string empty_text = "No meshes here");

    /// Goes to a folder, or to a file's folder and chooses the file.
    void go_to(const std::filesystem::path& path);
    /// Fills the given size; true when another file was chosen in this frame.
    bool draw(const EditorContext& context, ImVec2 size);
    /// Null path when none is chosen.
    const std::filesystem::path& chosen() const { return chosen_; }
    /// The folder whose files are listed.
    const std::filesystem::path& folder() const { return folder_; }
    /// Whether the chosen file was double-clicked in the last draw().
    bool confirmed() const { return confirmed_; }

private:
    struct Entry {
        std::string name;
        bool folder = false;
        std::uintmax_t bytes = 0;
    };
    void refresh();
    bool accept_typed_path();

    std::vector<std::string> extensions_;
    std::string empty_text_;
    std::filesystem::path folder_, chosen_;
    std::vector<Entry> entries_;
    std::string typed_, problem_;
    bool confirmed_ = false;
};

} // namespace fascicle::editor
