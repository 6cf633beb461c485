#pragma once
// The motion of a bone that turns with the timeline's joint.

#include "fascicle/scene/scene.hpp"

namespace fascicle::actions {

/// Gives the bone poses for the timeline's angles, at most an eighth of a turn from key to key. Nothing without a
/// joint. The bone must exist; missing tracks before it are made, at rest.
void give_hinge_track(Scene& scene, std::size_t bone);

} // namespace fascicle::actions
