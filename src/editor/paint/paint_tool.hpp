#pragma once
// The pointer while painting: brush strokes, fills, lasso, line; cursor and preview.

#include "editor/paint/paint_mode.hpp"
#include "editor/viewport_tool.hpp"
#include "fascicle/geometry/geodesic_line.hpp"

namespace fascicle::editor {

class PaintTool : public ViewportTool {
public:
    explicit PaintTool(PaintMode& paint) : paint_(paint) {}

    bool take_pointer(EditorContext& context, const PointerInput& input, const view::ViewSize& size) override;
    void draw(EditorContext& context, ImDrawList& list, const Rect& area) override;
    bool cancel(EditorContext& context) override;

    /// Points of the line so far.
    std::size_t line_points() const { return anchors_.size(); }
    /// Paints a strip along the open line.
    void finish_line(EditorContext& context);
    /// Takes back its last point.
    void line_back();
    /// For tests: what the cursor would change here.
    const std::vector<int>& preview() const { return preview_; }
    bool cursor_shown() const { return !ring_.empty(); }

private:
    enum class Grip { none, stroke, lasso, swallow };
    struct Hover { // what the preview was made from
        double x = 0, y = 0;
        bool ctrl = false, shift = false;
        PaintSettings settings;
        render::CameraPose camera;
        std::uint64_t version = 0;
        Pose pose;
        const SurfaceGraph* graph = nullptr;
    };
    PaintView view_of(const EditorContext& context, const view::ViewSize& size) const;
    actions::StrokeMode mode(bool ctrl, bool shift) const;
    void press(EditorContext& context, const PointerInput& input, const SurfacePoint& at);
    void step(EditorContext& context, const SurfacePoint& at, const Vec2& pointer);
    void apply_lasso(EditorContext& context);
    void add_line_point(EditorContext& context, const SurfacePoint& at, const Vec2& pointer, bool erase);
    void apply_line(EditorContext& context, const std::vector<int>& vertices, bool erase);
    void touch(EditorContext& context, const std::vector<int>& vertices);
    void hover(EditorContext& context, const PointerInput& input, const SurfacePoint& at);
    void make_preview(EditorContext& context, const PointerInput& input, const SurfacePoint& at);
    void forget_hover();

    PaintMode& paint_;
    Grip grip_ = Grip::none;
    actions::StrokeMode stroke_mode_ = actions::StrokeMode::paint;
    bool stroke_changed_ = false;
    PaintView view_;
    Vec2 last_pointer_ = Vec2::Zero();
    std::vector<Vec2> lasso_;
    std::vector<SurfacePoint> anchors_;
    std::vector<GeodesicLine> lines_;
    int line_bone_ = -1;
    GeodesicLine next_line_; ///< from the last point to the pointer
    // cursor
    bool hovering_ = false;
    std::optional<Hover> hover_;
    std::vector<int> preview_;
    Points ring_; ///< segments, bone coordinates
    PaintAim aim_;
};

} // namespace fascicle::editor
