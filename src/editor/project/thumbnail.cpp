#include "editor/project/thumbnail.hpp"

#include "editor/scene_view.hpp"

namespace fascicle::editor {

std::optional<PngImage> take_thumbnail(const EditorContext& context) {
    if (context.view == nullptr)
        return std::nullopt;
    try {
        render::Image image = context.view->picture(context, thumbnail_width, thumbnail_height);
        return PngImage{image.width, image.height, std::move(image.rgba)};
    } catch (const std::exception&) { // a picture is no reason not to save
        return std::nullopt;
    }
}

} // namespace fascicle::editor
