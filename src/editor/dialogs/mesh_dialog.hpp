#pragma once
// Chooses mesh files, shows them beside the scene, says what is in them, and adds them as bones and muscles.

#include "editor/dialogs/dialog.hpp"
#include "editor/dialogs/mesh_preview.hpp"
#include "editor/widgets/file_browser.hpp"

namespace fascicle::editor {

class MeshDialog : public Dialog {
public:
    MeshDialog();

    void open();
    /// With these files in the list, e.g. those dropped on the window; also while it is open.
    void open_with(const std::vector<std::filesystem::path>& files);
    bool is_open() const { return open_; }
    void close() override;
    bool busy() const override { return open_ && batch_.reading(); }
    void draw(EditorContext& context) override;
    const MeshBatch& batch() const { return batch_; }
    const MeshPreview& preview() const { return preview_; }

private:
    void poll(EditorContext& context);
    void draw_columns(EditorContext& context, ImVec2 room);
    void draw_list(EditorContext& context, ImVec2 size);
    void draw_row(EditorContext& context, int index, float width);
    void draw_details(EditorContext& context);
    void draw_role(EditorContext& context, const MeshEntry& entry);
    void draw_size(EditorContext& context, const MeshEntry& entry);
    void draw_axes(EditorContext& context, const MeshEntry& entry);
    void draw_findings(EditorContext& context, const MeshEntry& entry);
    void draw_foot(EditorContext& context, float width);
    void load(EditorContext& context);

    FileBrowser browser_;
    MeshBatch batch_;
    MeshPreview preview_;
    int selected_ = -1;
    bool open_ = false, appears_ = false;
    int seen_ready_ = 0; ///< entries that the preview was framed with
    std::string problem_;
};

} // namespace fascicle::editor
