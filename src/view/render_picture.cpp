#include "view/render_picture.hpp"

#include "fascicle/base/error.hpp"
#include "render/offscreen_target.hpp"
#include "render/osmesa_context.hpp"
#include "render/scene_renderer.hpp"

namespace fascicle::view {

PictureRenderer::PictureRenderer()
    : context_(std::make_unique<render::OsmesaContext>()),
      renderer_(std::make_unique<render::SceneRenderer>()) {}

PictureRenderer::~PictureRenderer() {
    context_->make_current(); // what is destroyed next belongs to it
}

render::Image PictureRenderer::draw(const render::DrawList& list, int width, int height, float line_scale) {
    context_->make_current();
    if (!target_ || target_->width() != width || target_->height() != height) {
        target_.reset();
        try {
            target_ = std::make_unique<render::OffscreenTarget>(width, height, 2);
        } catch (const Error&) {
            target_ = std::make_unique<render::OffscreenTarget>(width, height, 1);
        }
    }
    renderer_->draw(list, *target_, line_scale);
    return target_->read_back();
}

render::Image render_picture(const render::DrawList& list, int width, int height) {
    return PictureRenderer().draw(list, width, height);
}

} // namespace fascicle::view
