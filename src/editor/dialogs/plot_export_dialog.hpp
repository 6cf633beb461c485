#pragma once
// Writes plots as csv, SVG or PNG: what, in which form, under which name.

#include "editor/dialogs/dialog.hpp"
#include "editor/plot_table.hpp"
#include "editor/widgets/file_browser.hpp"

#include <future>

namespace fascicle::editor {

enum class PlotFile { csv, svg, png };

class PlotExportDialog : public Dialog {
public:
    PlotExportDialog() : browser_({".csv", ".svg", ".png"}) {}

    /// plots: ids of rows; visible_only: of a csv, only the frames in view.
    void open(const EditorContext& context, std::vector<std::string> plots, PlotFile format,
              bool visible_only);
    bool is_open() const { return open_; }
    void close() override { open_ = false; }
    bool busy() const override { return writing_.valid(); }
    void draw(EditorContext& context) override;
    /// Waits for the writer; for tests.
    void finish() const {
        if (writing_.valid())
            writing_.wait();
    }

private:
    void draw_what(EditorContext& context, float label);
    void draw_where(EditorContext& context, float width);
    std::filesystem::path target() const;
    void suggest(const EditorContext& context);
    void start(EditorContext& context);
    void poll(EditorContext& context);

    FileBrowser browser_;
    std::vector<std::string> plots_;
    PlotFile format_ = PlotFile::csv;
    bool visible_only_ = false, dark_ = false;
    int scale_ = 2, width_ = 640, height_ = 360;
    std::string name_, problem_;
    bool open_ = false, appears_ = false;
    std::future<std::string> writing_; ///< what was written, for the log
};

} // namespace fascicle::editor
