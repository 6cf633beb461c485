#include "editor/start/scene_pictures.hpp"

#include "editor/initial_view.hpp"
#include "editor/project/thumbnail.hpp"
#include "fascicle/geometry/bounding_box.hpp"
#include "fascicle/scene/embedded_scenes.hpp"
#include "render/offscreen_target.hpp"
#include "view/build_draw_list.hpp"

#include <chrono>

namespace fascicle::editor {

ScenePictures::~ScenePictures() = default; // the future waits

const PictureTexture& ScenePictures::picture(const std::string& name) {
    const auto [it, is_new] = pictures_.try_emplace(name);
    if (is_new)
        waiting_.push_back(name);
    return it->second;
}

void ScenePictures::wait() {
    if (making_.valid())
        making_.wait();
}

void ScenePictures::update(const EditorContext& context) {
    if (!making_.valid() && !waiting_.empty()) {
        name_ = waiting_.front();
        waiting_.pop_front();
        making_ = std::async(std::launch::async, [name = name_] {
            return std::make_shared<const Scene>(make_embedded_scene(name));
        });
    }
    if (!making_.valid() || making_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
        return;
    try {
        draw(context, making_.get(), pictures_[name_]);
    } catch (const std::exception&) { // a card without a picture can be clicked too
    }
    if (waiting_.empty())
        renderer_.reset();
}

void ScenePictures::draw(const EditorContext& context, const ScenePtr& scene, PictureTexture& picture) {
    if (renderer_ == nullptr)
        renderer_ = std::make_unique<render::SceneRenderer>();
    BoundingBox box;
    for (const Bone& bone : scene->bones)
        box.add(bounding_box(bone.mesh->positions, bone.mesh->triangles));
    for (const Muscle& muscle : scene->muscles)
        box.add(bounding_box(muscle.mesh->positions, muscle.mesh->triangles));
    const double aspect = double(thumbnail_width) / thumbnail_height;
    view::Camera camera;
    look_at_muscles(camera, *scene);
    camera.set_scene_bounds(box);
    camera.frame(box, aspect);
    view::ViewOptions options;
    options.joint_axis = false;
    view::DrawCache cache;
    render::DrawList list =
        view::build_draw_list(view::subject_of(scene), options, camera.pose(aspect), cache);
    // Clear, so that the card's own ground shows in either theme.
    list.background_top = list.background_bottom = {0, 0, 0, 0};
    const render::OffscreenTarget target(thumbnail_width, thumbnail_height, 2);
    renderer_->draw(list, target, 2 * context.state.scale);
    const render::Image image = target.read_back();
    picture.set(image.width, image.height, image.rgba.data());
}

} // namespace fascicle::editor
