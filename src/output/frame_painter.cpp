#include "output/frame_painter.hpp"

#include "fascicle/base/assert.hpp"

#include <algorithm>
#include <utility>

namespace fascicle::output {

namespace {

/// Pixels drawn around a tile and thrown away: wide lines and what looks at neighbouring pixels are right up to its border.
constexpr int margin = 16;

} // namespace

void FramePainter::begin(const view::ViewSubject& subject, const PictureLook& look) {
    FASCICLE_ASSERT(look.width >= 1 && look.height >= 1);
    list_ = view::build_draw_list(subject, look.options, look.camera.pose(double(look.width) / look.height),
                                  cache_);
    list_.background_top = look.background_top;
    list_.background_bottom = look.background_bottom;
    if (look.transparent)
        list_.background_top[3] = list_.background_bottom[3] = 0;
    line_scale_ = look.line_scale;
    tiles_ = view::picture_tiles(look.width, look.height, tile_side);
    next_ = 0;
    image_ = {look.width, look.height, {}};
    image_.rgba.resize(4 * static_cast<std::size_t>(look.width) * static_cast<std::size_t>(look.height));
}

bool FramePainter::step() {
    if (complete())
        return false;
    const view::PictureTile tile = tiles_[next_];
    const int around = tiles_.size() > 1 ? margin : 0;
    const int width = tile.width + 2 * around, height = tile.height + 2 * around;
    if (target_ == nullptr || target_->width() != width || target_->height() != height) {
        target_.reset();
        target_ = std::make_unique<render::OffscreenTarget>(width, height, 2);
    }
    const auto scale = line_scale_ * static_cast<float>(target_->supersampling());
    if (around > 0)
        renderer_.draw(view::list_of_tile(list_, image_.width, image_.height, tile, around), *target_, scale);
    else
        renderer_.draw(list_, *target_, scale);
    const render::Image part = target_->read_back();
    const auto row = [](const render::Image& image, int x, int y) {
        return 4 * (static_cast<std::ptrdiff_t>(y) * image.width + x);
    };
    for (int y = 0; y < tile.height; ++y) {
        const auto from = part.rgba.begin() + row(part, around, y + around);
        std::copy(from, from + 4 * static_cast<std::ptrdiff_t>(tile.width),
                  image_.rgba.begin() + row(image_, tile.x, tile.y + y));
    }
    ++next_;
    return true;
}

render::Image FramePainter::take() {
    FASCICLE_ASSERT(complete());
    return std::exchange(image_, {});
}

render::Image FramePainter::paint(const view::ViewSubject& subject, const PictureLook& look) {
    begin(subject, look);
    while (step()) {
    }
    return take();
}

} // namespace fascicle::output
