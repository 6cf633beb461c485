#include "editor/widgets/picture_texture.hpp"

#include "editor/widgets/icons.hpp"
#include "editor/widgets/paint.hpp"
#include "fascicle/io/png.hpp"
#include "render/gl_functions.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace fascicle::editor {

namespace gl = render::gl;

PictureTexture::~PictureTexture() {
    if (name_ != 0)
        gl::DeleteTextures(1, &name_);
}

PictureTexture& PictureTexture::operator=(PictureTexture&& other) noexcept {
    std::swap(name_, other.name_);
    std::swap(width_, other.width_);
    std::swap(height_, other.height_);
    std::swap(file_, other.file_);
    std::swap(tried_, other.tried_);
    return *this;
}

void PictureTexture::load(const EditorContext& context, const std::filesystem::path& file) {
    if (context.view == nullptr || (tried_ && file == file_))
        return;
    tried_ = true;
    file_ = file;
    try {
        if (!file.empty()) {
            const PngImage image = read_png(file);
            set(image.width, image.height, image.rgba.data());
        }
    } catch (const std::exception&) { // a card without a picture says enough
    }
}

void PictureTexture::set(int width, int height, const unsigned char* rgba) {
    if (name_ == 0)
        gl::GenTextures(1, &name_);
    gl::BindTexture(GL_TEXTURE_2D, name_);
    gl::TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl::TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl::TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl::TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    gl::PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl::TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
    gl::BindTexture(GL_TEXTURE_2D, 0);
    width_ = width;
    height_ = height;
}

void PictureTexture::draw(const EditorContext& context, const Rect& area, float alpha) const {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float round = context.px(4);
    if (empty()) {
        list.AddRectFilled(area.min, area.max, context.theme.plot, round);
        draw_text_in(list, area, with_alpha(context.theme.text_faint, 0.6f * alpha), text(icons::cube),
                     Align::centre);
        return;
    }
    // The middle of the picture, in the shape of the area.
    const float shape = area.width() / std::max(1.0f, area.height()),
                own = static_cast<float>(width_) / static_cast<float>(height_);
    const float u = own > shape ? (1 - shape / own) / 2 : 0, v = own < shape ? (1 - own / shape) / 2 : 0;
    list.AddImageRounded(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(name_)), area.min,
                         area.max, {u, v}, {1 - u, 1 - v},
                         IM_COL32(255, 255, 255, static_cast<int>(alpha * 255)), round);
}

} // namespace fascicle::editor
