#pragma once
// Files that a scene came from and that other programs change meanwhile.

#include "fascicle/scene/scene.hpp"

namespace fascicle {

/// Files whose contents the scene stands for as they are, each once: meshes, attachments, fibres, templates, line muscles.
std::vector<MeshSource> scene_sources(const Scene& scene);

/// The scene with the files of these paths read anew. Painted areas and attachments of a mesh whose number of vertices is
/// another now are left out, with a note. Error as when they were read first.
Scene reload_sources(const Scene& scene, const std::vector<std::string>& paths,
                     std::vector<std::string>& notes);

} // namespace fascicle
