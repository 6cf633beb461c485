#pragma once
// From where a scene is looked at when it is opened.

#include "fascicle/scene/scene.hpp"
#include "view/camera.hpp"

namespace fascicle::editor {

/// Turns the camera, a little above the horizon, to the side from which the most muscles are seen. Distance and pivot are
/// left to framing. A scene without muscles is seen from the front, the left and a little above.
void look_at_muscles(view::Camera& camera, const Scene& scene);

} // namespace fascicle::editor
