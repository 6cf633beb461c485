#pragma once
// Repairs the mesh of a bone or muscle: what is wrong, what would be done, both as pictures; nothing changes before Apply.

#include "editor/dialogs/dialog.hpp"
#include "editor/dialogs/mesh_preview.hpp"
#include "editor/dialogs/repair_job.hpp"

namespace fascicle::editor {

class RepairDialog : public Dialog {
public:
    /// For the selected bone or muscle, which must exist.
    void open(EditorContext& context);
    bool is_open() const { return open_; }
    void close() override;
    bool busy() const override { return open_ && (job_ != nullptr || changed_); }
    void draw(EditorContext& context) override;
    /// Null while it is being found out, and after an error.
    const RepairOutcome* outcome() const { return outcome_ ? &*outcome_ : nullptr; }
    const MeshPreview& preview() const { return preview_; }

private:
    /// As the person sees them: lengths in mm, shares in percent.
    struct Choices {
        bool own_weld = false;
        double weld_mm = 0.01;
        int fill_edges = 100;
        bool fill_large = false;
        double island_percent = 1;
        int smooth_passes = 0;
        int remesh = 0; ///< 0 no, 1 to an edge length, 2 to a number
        double edge_mm = 3;
        int triangles = 5000;
        bool untangle = false;
        bool operator==(const Choices&) const = default;
    };
    void poll(EditorContext& context);
    RepairOptions options(const EditorContext& context) const;
    void draw_choices(EditorContext& context);
    void draw_remesh(EditorContext& context);
    void draw_preview(EditorContext& context, ImVec2 size);
    void draw_outcome(EditorContext& context);
    void draw_measures(EditorContext& context);
    void draw_foot(EditorContext& context);
    std::string why_not() const; ///< why it cannot be applied now; empty: it can
    void apply(EditorContext& context);
    void show(bool after);

    bool open_ = false, appears_ = false;
    Selection object_;
    MeshPtr input_;
    int mm_ = 1; ///< in a unit of the scene
    Choices choices_;
    bool changed_ = false; ///< choices, since the last job began
    double changed_at_ = 0;
    std::unique_ptr<RepairJob> job_;
    std::vector<std::unique_ptr<RepairJob>> given_up_;
    std::optional<RepairOutcome> outcome_;
    std::string problem_;
    MeshBatch batch_; ///< the mesh that is shown
    MeshPreview preview_;
    bool show_after_ = true;
};

} // namespace fascicle::editor
