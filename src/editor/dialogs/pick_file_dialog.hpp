#pragma once
// Asks for one file of a kind and hands its path on.

#include "editor/dialogs/dialog.hpp"
#include "editor/widgets/file_browser.hpp"

#include <functional>

namespace fascicle::editor {

class PickFileDialog : public Dialog {
public:
    /// What is done with the file; an Error keeps the dialog open and shows the line.
    using Use = std::function<void(EditorContext&, const std::filesystem::path&)>;

    /// extensions: lower case with the dot. button: what confirms, one word.
    void open(std::string title, std::vector<std::string> extensions, std::string button, Use use);
    void draw(EditorContext& context) override;
    void close() override { open_ = false; }
    bool is_open() const { return open_; }
    /// Goes to a file and chooses it, as typing its path does.
    void go_to(const std::filesystem::path& path);

private:
    void use(EditorContext& context);

    std::optional<FileBrowser> browser_;
    std::string title_, button_, problem_;
    Use use_;
    bool open_ = false, appears_ = false;
};

} // namespace fascicle::editor
