#pragma once
// New meshes beside what is in the scene, with their defects as bright lines. Drawn only when something changed.

#include "editor/dialogs/mesh_batch.hpp"
#include "editor/editor_context.hpp"
#include "editor/viewport_pointer.hpp"
#include "render/offscreen_target.hpp"
#include "render/scene_renderer.hpp"
#include "view/build_draw_list.hpp"

namespace fascicle::editor {

class MeshPreview {
public:
    /// Fills the area; drags turn, wheel zooms, a double-click fits. `selected`: entry drawn brighter, -1: none.
    void draw(EditorContext& context, const MeshBatch& batch, int selected, const Rect& area);
    /// Everything into view at the next picture.
    void frame() { frame_pending_ = true; }
    /// Gives the pictures back to the GPU; the scene is let go.
    void release();
    int drawn() const { return drawn_; } ///< pictures so far, for tests

private:
    unsigned texture(const EditorContext& context, const MeshBatch& batch, int selected, int width,
                     int height);
    void rebuild(const EditorContext& context, const MeshBatch& batch);
    render::DrawList build(const EditorContext& context, const MeshBatch& batch, int selected, double aspect);
    void handle_pointer(const EditorContext& context, const Rect& area);

    struct Gpu { // made when a GL context is known to be there
        render::SceneRenderer renderer;
        std::unique_ptr<render::OffscreenTarget> target;
    };
    std::unique_ptr<Gpu> gpu_;
    view::DrawCache cache_;
    view::Camera camera_;
    ViewportPointer pointer_;
    ScenePtr scene_, scene_for_; ///< with the new meshes behind the head's own; the head it was made from
    std::uint64_t revision_ = 0;
    BoundingBox bounds_; ///< of scene_
    struct Key {
        std::uint64_t revision = 0;
        ScenePtr head;
        int selected = -1, width = 0, height = 0, samples = 0;
        bool dark = false;
        render::CameraPose camera;
    };
    std::optional<Key> key_;
    bool frame_pending_ = true;
    int drawn_ = 0;
};

} // namespace fascicle::editor
