#pragma once
// Draws a DrawList: gradient background, opaque surfaces with their cuts, ambient occlusion, lines, transparent surfaces from far
// to near, lines on top.

#include "render/draw_list.hpp"
#include "render/mesh_buffer.hpp"
#include "render/occlusion_pass.hpp"
#include "render/offscreen_target.hpp"
#include "render/shader.hpp"

#include <unordered_map>

namespace fascicle::render {

class SceneRenderer {
public:
    /// A GL context must be current and stay alive longer than the renderer.
    SceneRenderer();
    ~SceneRenderer();
    SceneRenderer(const SceneRenderer&) = delete;
    SceneRenderer& operator=(const SceneRenderer&) = delete;

    /// Draws into the bound framebuffer, all of a viewport of width x height pixels, clearing it first.
    /// pixel_scale: framebuffer pixels per pixel of line widths (supersampling times the interface's scale). Without caps of
    /// cut solids and without occlusion, which need a target's stencil and depth.
    void draw(const DrawList& list, int width, int height, float pixel_scale = 1.0f);
    /// draw() into all of `target`, then resolve().
    void draw(const DrawList& list, const OffscreenTarget& target, float pixel_scale = 1.0f);

    /// Arrays sent to the GPU by the last draw(): 0 when nothing but the camera changed.
    int uploads() const { return uploads_; }
    /// Vertex colours among them: of live colours, those that changed.
    std::size_t colours_sent() const { return colours_sent_; }

private:
    struct Entry {
        std::unique_ptr<MeshBuffer> buffer;
        std::shared_ptr<const std::vector<Vec3f>> positions; ///< that the ball is around
        Vec3f centre{};
        float radius = 0;
        std::uint64_t last_drawn = 0;
    };
    struct Pass;
    void draw(const DrawList& list, int width, int height, float pixel_scale, const OffscreenTarget* target);
    Entry& entry_of(const SurfaceItem& item);
    void draw_surface(const SurfaceItem& item, const Pass& pass);
    void draw_cap(const SurfaceItem& item, const Pass& pass);
    void draw_transparent(const DrawList& list, const Pass& pass);
    void draw_lines(const LineItem& item, const Pass& pass);
    void forget_unused();

    Shader background_, surface_, wired_surface_, line_, cap_;
    OcclusionPass occlusion_;
    std::unordered_map<std::uint64_t, Entry> entries_; ///< by SurfaceItem.id
    std::uint64_t draws_ = 0;
    int uploads_ = 0;
    std::size_t colours_sent_ = 0;
    unsigned empty_array_ = 0, line_array_ = 0, line_points_ = 0, line_colours_ = 0;
};

} // namespace fascicle::render
