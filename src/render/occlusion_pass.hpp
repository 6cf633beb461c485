#pragma once
// Ambient occlusion in screen space: darkens what is drawn where, by the depth buffer, other surfaces are near.

#include "render/offscreen_target.hpp"
#include "render/shader.hpp"

namespace fascicle::render {

/// At the resolution of the finished picture, whatever the supersampling, or at half of it where that is large: depth to occlusion (after M. McGuire, B. Osman, M.
/// Bukowski, P. Hennessy, "The Alchemy screen-space ambient obscurance algorithm", HPG 2011), a blur that keeps to one surface,
/// then a multiplication of the colours.
class OcclusionPass {
public:
    OcclusionPass();
    ~OcclusionPass();
    OcclusionPass(const OcclusionPass&) = delete;
    OcclusionPass& operator=(const OcclusionPass&) = delete;

    /// Darkens the samples of `target` drawn so far and leaves it bound, without blending and without a depth test. projection:
    /// the one they were drawn with; radius > 0: scene units. Error when the driver cannot make the buffers.
    void apply(const OffscreenTarget& target, const Mat4f& projection, float radius);

private:
    void make_buffers(int width, int height);
    void release_buffers();

    Shader occlusion_, blur_, multiply_;
    unsigned empty_array_ = 0;
    int width_ = 0, height_ = 0;
    unsigned textures_[2] = {0, 0}, framebuffers_[2] = {0, 0}; ///< raw, blurred
};

} // namespace fascicle::render
