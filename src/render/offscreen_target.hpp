#pragma once
// A picture in GPU memory to draw into, with depth and stencil, optionally supersampled 2x2.

#include "render/draw_list.hpp"

#include <string>

namespace fascicle::render {

/// Error naming the driver's reason when the bound framebuffer cannot be drawn to. `what` starts the message.
void require_complete_framebuffer(const std::string& what);

class OffscreenTarget {
public:
    /// width, height: pixels of the finished picture. supersampling: 1, or 2 for four samples a pixel (sRGB
    /// values are averaged). Error when the driver cannot make it (too large, out of memory) or when a size
    /// is below 1.
    OffscreenTarget(int width, int height, int supersampling = 1);
    ~OffscreenTarget();
    OffscreenTarget(const OffscreenTarget&) = delete;
    OffscreenTarget& operator=(const OffscreenTarget&) = delete;

    int width() const { return width_; }
    int height() const { return height_; }
    int supersampling() const { return supersampling_; }

    /// Makes it the target of what is drawn next, with the viewport set to all its samples.
    void bind() const;
    /// Averages the samples into texture(). Needed after drawing and before texture() or read_back().
    void resolve() const;
    /// GL name of the finished RGBA picture, rows from the bottom (ImGui::Image: uv (0,1) to (1,0)).
    unsigned texture() const { return texture_; }
    /// GL name of the depth of all samples, for shaders. Not to be read while something is drawn into this with a depth test.
    unsigned depth_texture() const { return depth_; }
    /// Copies the finished picture into the window's framebuffer `to`, lower left corner at (x, y) in its
    /// pixels.
    void blit_to(unsigned to, int x, int y) const;
    /// The finished picture. Colours are divided by alpha again where the background was transparent.
    Image read_back() const;

private:
    void release();

    int width_, height_, supersampling_;
    unsigned texture_ = 0, framebuffer_ = 0;                    ///< finished picture
    unsigned samples_ = 0, sample_framebuffer_ = 0, depth_ = 0; ///< samples_ is 0 without supersampling
};

} // namespace fascicle::render
