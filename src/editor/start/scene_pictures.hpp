#pragma once
// Small pictures of the embedded scenes, made one after the other in the background.

#include "editor/widgets/picture_texture.hpp"
#include "fascicle/scene/scene.hpp"
#include "render/scene_renderer.hpp"

#include <deque>
#include <future>
#include <map>
#include <memory>

namespace fascicle::editor {

class ScenePictures {
public:
    ~ScenePictures();
    /// The picture of an embedded scene; empty as long as it is not there. Asking for it has it made.
    const PictureTexture& picture(const std::string& name);
    /// Takes a scene that is made and draws it; once a frame. A GL context must be current.
    void update(const EditorContext& context);
    bool busy() const { return making_.valid() || !waiting_.empty(); }
    /// Waits for the scene that is being made.
    void wait();

private:
    void draw(const EditorContext& context, const ScenePtr& scene, PictureTexture& picture);
    std::map<std::string, PictureTexture> pictures_;
    std::deque<std::string> waiting_;
    std::string name_; ///< of the scene being made
    std::future<ScenePtr> making_;
    std::unique_ptr<render::SceneRenderer> renderer_; ///< while there is something to draw
};

} // namespace fascicle::editor
