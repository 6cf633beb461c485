#pragma once
// Chooses a csv whose curves are to lie over a plot.

#include "editor/dialogs/dialog.hpp"
#include "editor/widgets/file_browser.hpp"

namespace fascicle::editor {

class PlotOverlayDialog : public Dialog {
public:
    PlotOverlayDialog() : browser_({".csv", ".txt", ".tsv"}) {}
    /// plot: id of its row.
    void open(const std::string& plot);
    void close() override { open_ = false; }
    void draw(EditorContext& context) override;

private:
    FileBrowser browser_;
    std::string plot_;
    bool open_ = false, appears_ = false;
};

} // namespace fascicle::editor
