#include "render/offscreen_target.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/base/error.hpp"
#include "render/gl_functions.hpp"

#include <algorithm>

namespace fascicle::render {

namespace {

std::string status_name(GLenum status) {
    switch (status) {
    case GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT:
        return "an attachment is incomplete (out of memory?)";
    case GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT:
        return "it has no attachment";
    case GL_FRAMEBUFFER_INCOMPLETE_MULTISAMPLE:
        return "its samples do not match";
    case GL_FRAMEBUFFER_UNSUPPORTED:
        return "its formats are not supported";
    default:
        return "status " + std::to_string(status);
    }
}

unsigned make_texture(int width, int height) {
    unsigned texture = 0;
    gl::GenTextures(1, &texture);
    gl::BindTexture(GL_TEXTURE_2D, texture);
    gl::TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    gl::TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl::TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl::TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl::TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return texture;
}

/// Depth and stencil; a texture, so that occlusion can be told from the depth.
unsigned make_depth(int width, int height) {
    unsigned texture = 0;
    gl::GenTextures(1, &texture);
    gl::BindTexture(GL_TEXTURE_2D, texture);
    gl::TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH24_STENCIL8, width, height, 0, GL_DEPTH_STENCIL,
                   GL_UNSIGNED_INT_24_8, nullptr);
    gl::TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl::TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl::TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl::TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return texture;
}

} // namespace

void require_complete_framebuffer(const std::string& what) {
    const GLenum status = gl::CheckFramebufferStatus(GL_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE)
        throw_error(what, "the driver cannot draw into this framebuffer: " + status_name(status));
}

OffscreenTarget::OffscreenTarget(int width, int height, int supersampling)
    : width_(width), height_(height), supersampling_(supersampling) {
    FASCICLE_ASSERT(supersampling == 1 || supersampling == 2);
    const std::string what = "picture of " + std::to_string(width) + "x" + std::to_string(height) + " pixels";
    if (width < 1 || height < 1)
        throw_error(what, "the size is not possible", "at least 1x1");
    GLint texture_limit = 0;
    gl::GetIntegerv(GL_MAX_TEXTURE_SIZE, &texture_limit);
    const int limit = texture_limit / supersampling;
    if (width > limit || height > limit)
        throw_error(what, "too large for the graphics driver",
                    "at most " + std::to_string(limit) + " pixels a side");

    while (gl::GetError() != GL_NO_ERROR) {
        // An older error of somebody else must not be taken for ours.
    }
    try {
        const int sample_width = width * supersampling, sample_height = height * supersampling;
        texture_ = make_texture(width, height);
        if (supersampling > 1)
            samples_ = make_texture(sample_width, sample_height);
        depth_ = make_depth(sample_width, sample_height);

        gl::GenFramebuffers(1, &framebuffer_);
        gl::BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
        gl::FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, 0);
        if (supersampling > 1) {
            require_complete_framebuffer(what);
            gl::GenFramebuffers(1, &sample_framebuffer_);
            gl::BindFramebuffer(GL_FRAMEBUFFER, sample_framebuffer_);
            gl::FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, samples_, 0);
        }
        gl::FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_TEXTURE_2D, depth_, 0);
        require_complete_framebuffer(what);
        if (const GLenum error = gl::GetError(); error != GL_NO_ERROR)
            throw_error(what, "the graphics driver refused it (GL error " + std::to_string(error) + ")");
    } catch (...) {
        release();
        throw;
    }
}

OffscreenTarget::~OffscreenTarget() {
    release();
}

void OffscreenTarget::release() {
    gl::BindFramebuffer(GL_FRAMEBUFFER, 0);
    gl::DeleteFramebuffers(1, &framebuffer_);
    gl::DeleteFramebuffers(1, &sample_framebuffer_);
    gl::DeleteTextures(1, &depth_);
    gl::DeleteTextures(1, &texture_);
    gl::DeleteTextures(1, &samples_);
}

void OffscreenTarget::bind() const {
    gl::BindFramebuffer(GL_FRAMEBUFFER, supersampling_ > 1 ? sample_framebuffer_ : framebuffer_);
    gl::Viewport(0, 0, width_ * supersampling_, height_ * supersampling_);
}

void OffscreenTarget::resolve() const {
    if (supersampling_ == 1)
        return;
    gl::Disable(GL_SCISSOR_TEST); // it would cut the copy
    gl::BindFramebuffer(GL_READ_FRAMEBUFFER, sample_framebuffer_);
    gl::BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_);
    // At exactly half size a linear filter samples the common corner of 2x2 texels: their mean.
    gl::BlitFramebuffer(0, 0, width_ * 2, height_ * 2, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_LINEAR);
}

void OffscreenTarget::blit_to(unsigned to, int x, int y) const {
    gl::Disable(GL_SCISSOR_TEST);
    gl::BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
    gl::BindFramebuffer(GL_DRAW_FRAMEBUFFER, to);
    gl::BlitFramebuffer(0, 0, width_, height_, x, y, x + width_, y + height_, GL_COLOR_BUFFER_BIT,
                        GL_NEAREST);
}

Image OffscreenTarget::read_back() const {
    Image image{width_, height_, {}};
    const std::size_t row = std::size_t{4} * static_cast<std::size_t>(width_);
    image.rgba.resize(row * static_cast<std::size_t>(height_));
    gl::BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    gl::PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl::ReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, image.rgba.data());
    for (std::size_t top = 0, bottom = static_cast<std::size_t>(height_) - 1; top < bottom; ++top, --bottom)
        std::swap_ranges(image.rgba.begin() + static_cast<std::ptrdiff_t>(top * row),
                         image.rgba.begin() + static_cast<std::ptrdiff_t>((top + 1) * row),
                         image.rgba.begin() + static_cast<std::ptrdiff_t>(bottom * row));
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
        const int alpha = image.rgba[i + 3];
        if (alpha == 0 || alpha == 255)
            continue;
        for (std::size_t c = 0; c < 3; ++c)
            image.rgba[i + c] =
                static_cast<std::uint8_t>(std::min(255, (image.rgba[i + c] * 255 + alpha / 2) / alpha));
    }
    return image;
}

} // namespace fascicle::render
