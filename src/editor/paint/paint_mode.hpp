#pragma once
// Painting attachment areas on a bone: what is painted for whom, the stroke under way, the numbers. The pointer's side of it is
// PaintTool, the buttons' PaintPanel.

#include "editor/commands.hpp"
#include "editor/feature.hpp"
#include "editor/paint/paint_measure.hpp"
#include "editor/paint/paint_mirror.hpp"
#include "editor/paint/paint_settings.hpp"
#include "editor/paint/paint_surfaces.hpp"
#include "editor/paint/paint_touch.hpp"
#include "view/build_draw_list.hpp"

#include <map>

namespace fascicle::editor {

enum class AreaOperation { keep_largest, fill_holes, invert, clear, grow, shrink };

class PaintMode : public Feature {
public:
    PaintSettings settings;

    // Entering and leaving.
    /// Whether painting could begin: a bone is selected (or a muscle that is attached to one) and there is a muscle.
    CommandState can_enter(const EditorContext& context) const;
    void enter(EditorContext& context);
    void leave(EditorContext& context);

    // Who is painted. Indices of the document's scene; -1 outside of paint mode.
    int bone(const EditorContext& context) const;
    int muscle(const EditorContext& context) const;
    void set_muscle(const EditorContext& context, int muscle);
    void set_bone(EditorContext& context, int bone);
    std::optional<actions::AreaKey> key(const EditorContext& context) const;
    /// The area that is painted; null when nothing is painted yet.
    const AttachmentArea* area(const EditorContext& context) const;
    /// Names of the muscle's heads, of its areas, outlines and those added here; the first is always "".
    std::vector<std::string> heads(const EditorContext& context) const;
    void add_head(const EditorContext& context, const std::string& head);
    void remove_head(EditorContext& context, const std::string& head);

    /// Surface of the painted bone; null while it is prepared.
    GeodesicSearch* search(const EditorContext& context);
    BoneSurfaces* surfaces(const EditorContext& context);
    bool has_surface(const MeshPtr& mesh) { return surfaces_.ready(mesh) != nullptr; }
    bool preparing() const { return surfaces_.busy(); }
    /// Why a stroke cannot begin now; empty: it can.
    std::string blocked(const EditorContext& context) const;
    PaintMirror mirror(const EditorContext& context) const;
    /// Areas whose label is locked, on any bone.
    std::vector<actions::AreaKey> locked(const EditorContext& context) const;

    // Strokes. What is pressed begins one, what is released finishes it; nothing else may edit the document meanwhile.
    bool begin_stroke(EditorContext& context, actions::StrokeMode mode, const Brush& brush,
                      const std::string& what = {});
    actions::AreaStroke* stroke() { return stroke_.get(); }
    bool stroke_open() const { return stroke_ != nullptr; }
    bool stroke_mirrors() const { return stroke_mirrors_; }
    /// Vertices on the mirrored bone for vertices of this one.
    std::vector<int> mirrored_vertices(const EditorContext& context, const std::vector<int>& vertices);
    void finish_stroke();
    void cancel_stroke();

    /// One undo step; nothing when nothing changes or the label is locked.
    void apply(EditorContext& context, AreaOperation operation);
    /// The muscle's outlines become its areas; notes and errors go to the messages.
    void from_outlines(EditorContext& context);
    CommandState can_apply(const EditorContext& context, AreaOperation operation) const;

    // What is shown.
    const PaintMeasure& measure() const { return measure_; }
    const FixedVertices& fixed() const { return fixed_; }
    PaintFills& fills() { return fills_; }
    /// Sizes of an area in scene units squared, of any bone.
    double size_of(const EditorContext& context, const AttachmentArea& area);
    /// What the view shows of the document's areas, painted or not.
    view::ShownAreas shown_areas(const EditorContext& context);
    std::shared_ptr<const view::ViewSubject::MarkedVertices> marked_vertices(const EditorContext& context);
    const std::shared_ptr<const std::vector<view::BoneHighlight>>& highlights() const { return highlights_; }
    void set_highlights(std::vector<view::BoneHighlight> highlights);

    /// Waits for what is computed beside (tests, pictures).
    void finish(EditorContext& context);

    void update(EditorContext& context) override;
    void document_replaced(EditorContext& context) override;
    std::optional<double> redraw_after() const override;

private:
    SurfaceRegion without_locked(const EditorContext& context, const SurfaceRegion& region) const;

    bool active_ = false;
    std::string bone_, muscle_; ///< names
    std::string side_panel_before_;
    Selection followed_; ///< the selection that bone and muscle follow
    std::map<std::string, std::vector<std::string>> added_heads_; ///< by muscle
    PaintSurfaces surfaces_;
    PaintMeasure measure_;
    FixedVertices fixed_;
    PaintFills fills_;
    Document* stroke_document_ = nullptr;
    std::unique_ptr<actions::AreaStroke> stroke_;
    bool stroke_mirrors_ = false;
    struct Size {
        const TriMesh* mesh;
        SurfaceRegion vertices;
        double size;
    };
    std::vector<Size> sizes_;
    view::ShownAreas shown_;
    std::uint64_t shown_version_ = 0;
    int shown_on_top_ = -1;
    std::shared_ptr<const view::ViewSubject::MarkedVertices> marked_;
    std::shared_ptr<const std::vector<int>> marked_from_;
    std::shared_ptr<const std::vector<view::BoneHighlight>> highlights_;
};

} // namespace fascicle::editor
