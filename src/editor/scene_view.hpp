#pragma once
// The 3D picture of the viewport: drawn into a texture of the current GL context, and only when something changed.

#include "editor/editor_context.hpp"
#include "render/offscreen_target.hpp"
#include "render/scene_renderer.hpp"
#include "view/build_draw_list.hpp"

namespace fascicle::editor {

/// What the view shows now: scene, frame and options from the editor's state.
view::ViewSubject view_subject(const EditorContext& context);
view::ViewOptions view_options(const EditorContext& context, const Scene& scene);

class SceneView {
public:
    /// A GL context must be current. best_quality: every picture supersampled, whatever it costs; otherwise only
    /// when drawing is quick or nothing moves.
    explicit SceneView(bool best_quality);

    /// GL texture with the picture, rows from the bottom, for the next frame's use. width, height >= 1 pixels.
    unsigned texture(const EditorContext& context, int width, int height);
    /// The same of another subject, such as one of two runs side by side.
    unsigned texture(const EditorContext& context, const view::ViewSubject& subject, int width, int height);
    /// A picture that has not changed for this long is drawn again, supersampled.
    static constexpr double refine_after_seconds = 0.25;
    /// Whether the last picture should be drawn again, better, now that nothing moves.
    bool refinement_pending() const { return refinement_pending_; }
    /// Whether colours are still being made beside the interface.
    bool waiting() const { return cache_.rest_fields().waiting(); }
    /// A picture of its own, not of the screen's size.
    render::Image picture(const EditorContext& context, int width, int height);
    bool best_quality() const { return best_quality_; }
    /// Pictures drawn so far, for tests.
    int drawn() const { return drawn_; }
    /// CPU seconds of this thread spent in GL so far.
    double raster_seconds() const { return raster_seconds_; }

private:
    /// All that the picture depends on.
    struct Key {
        ScenePtr scene;
        FramePtr frame;
        std::size_t attachment_count = 0;
        view::ShownAreas areas;
        std::shared_ptr<const std::vector<view::BoneHighlight>> highlights;
        std::shared_ptr<const view::ViewSubject::MarkedVertices> marked;
        std::vector<PointsPtr> compared;
        render::CameraPose camera;
        view::ViewOptions options;
        bool dark = false;
        int width = 0, height = 0;
        float scale = 1;
        std::vector<FibreModelPtr> fibres{};
    };
    static bool same(const Key& a, const Key& b);
    render::Image image_of(const EditorContext& context, const view::ViewSubject& subject, int width,
                           int height);
    render::DrawList build(const EditorContext& context, const view::ViewSubject& subject, double aspect);

    render::SceneRenderer renderer_;
    view::DrawCache cache_;
    std::unique_ptr<render::OffscreenTarget> plain_, fine_;
    Key key_;
    bool best_quality_;
    bool has_picture_ = false, refinement_pending_ = false, shows_fine_ = false;
    double changed_ = 0;      ///< when the picture last changed
    double fine_seconds_ = 0; ///< what a supersampled picture cost lately
    int drawn_ = 0;
    double raster_seconds_ = 0;
};

} // namespace fascicle::editor
