#pragma once
// What a run is to be written as, how, and where.

#include "editor/dialogs/dialog.hpp"
#include "editor/widgets/file_browser.hpp"
#include "output/export_kinds.hpp"

namespace fascicle::editor {

class ExportDialog : public Dialog {
public:
    ExportDialog();
    void open(EditorContext& context);
    /// Opens by itself, with the reason and another name, when an export has failed.
    void draw(EditorContext& context) override;
    void close() override { open_ = false; }

private:
    void draw_kinds(EditorContext& context, ImVec2 size);
    void draw_options(EditorContext& context, ImVec2 size);
    void draw_frames(EditorContext& context);
    void draw_size(EditorContext& context);
    void draw_speed(EditorContext& context);
    void draw_morphs(EditorContext& context);
    void draw_up(EditorContext& context);
    void draw_target(EditorContext& context, ImVec2 size);
    void draw_note(EditorContext& context, const std::filesystem::path& target, float width);
    void start(EditorContext& context);
    void fail(EditorContext& context, const output::ExportRequest& request, const std::string& text);
    /// "Frames   |": a dim label, and what follows stands beside it.
    static void label(const EditorContext& context, const char* text);
    output::ExportRequest request(const EditorContext& context) const;
    std::filesystem::path target(const EditorContext& context) const;
    /// Pictures that the request would draw.
    int picture_count(const EditorContext& context) const;
    std::pair<int, int> picture_size(const EditorContext& context) const;

    FileBrowser browser_;
    bool open_ = false, appears_ = false, browsing_ = false;
    std::string problem_;           ///< of the last try
    std::filesystem::path instead_; ///< another name that can be taken
};

} // namespace fascicle::editor
