#pragma once
// Pictures without a display, for the command line and tests. Not for a program that has a window open: there, draw
// into an OffscreenTarget of the window's own context.

#include "render/draw_list.hpp"

#include <memory>

namespace fascicle::render {
class OsmesaContext;
class OffscreenTarget;
class SceneRenderer;
} // namespace fascicle::render

namespace fascicle::view {

/// Keeps context, shaders and buffers between pictures.
class PictureRenderer {
public:
    /// Error when OSMesa is missing.
    PictureRenderer();
    ~PictureRenderer();
    PictureRenderer(const PictureRenderer&) = delete;
    PictureRenderer& operator=(const PictureRenderer&) = delete;

    /// Draws the list, supersampled 2x2 (1x1 when the doubled size is beyond the driver). line_scale multiplies line
    /// widths (pictures at 2x to 4x). Error when the size is impossible.
    render::Image draw(const render::DrawList& list, int width, int height, float line_scale = 1.0f);

private:
    std::unique_ptr<render::OsmesaContext> context_;
    std::unique_ptr<render::SceneRenderer> renderer_;
    std::unique_ptr<render::OffscreenTarget> target_;
};

/// One picture. For several keep a PictureRenderer.
render::Image render_picture(const render::DrawList& list, int width, int height);

} // namespace fascicle::view
