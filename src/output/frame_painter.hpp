#pragma once
// Pictures of frames, drawn step by step in the current GL context, so that a window stays alive meanwhile.

#include "render/offscreen_target.hpp"
#include "render/scene_renderer.hpp"
#include "view/build_draw_list.hpp"
#include "view/picture_tiles.hpp"

namespace fascicle::output {

/// How pictures of a run look.
struct PictureLook {
    view::Camera camera;
    view::ViewOptions options;
    int width = 1280, height = 800;                      ///< pixels of the finished picture
    render::Rgba background_top{0.93f, 0.94f, 0.96f, 1}; ///< as render::DrawList
    render::Rgba background_bottom{0.78f, 0.81f, 0.85f, 1};
    bool transparent = false; ///< no background at all
    float line_scale = 1;     ///< of the widths of lines
};

/// Keeps shaders, buffers and targets between pictures. Made, used and destroyed with the same GL context current.
class FramePainter {
public:
    /// Largest side of what is drawn in one step.
    static constexpr int tile_side = 1024;

    /// Begins a picture, supersampled 2x2. Error when the size is impossible.
    void begin(const view::ViewSubject& subject, const PictureLook& look);
    /// Draws one tile of it; false when the picture was complete already.
    bool step();
    bool complete() const { return next_ == tiles_.size(); }
    /// The finished picture.
    render::Image take();

    /// All of it at once.
    render::Image paint(const view::ViewSubject& subject, const PictureLook& look);

private:
    render::SceneRenderer renderer_;
    view::DrawCache cache_;
    std::unique_ptr<render::OffscreenTarget> target_;
    render::DrawList list_;
    render::Image image_;
    float line_scale_ = 1;
    std::vector<view::PictureTile> tiles_;
    std::size_t next_ = 0;
};

} // namespace fascicle::output
