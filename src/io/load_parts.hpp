#pragma once
// Steps that every way of making a scene from mesh files has.

#include "fascicle/io/load_scene.hpp"

namespace fascicle::io {

/// Attachment outlines and surface fibres of the request into the muscles of those names; step: called before each file.
void load_muscle_files(Scene& scene, const SceneRequest& request, const std::function<void()>& step,
                       std::vector<std::string>& notes);

/// Error (usage) when two meshes have one name.
void require_unique_names(const Scene& scene);

} // namespace fascicle::io
