#pragma once
// Steps that every way of making a scene from mesh files has.

#include "fascicle/io/load_scene.hpp"

namespace fascicle::io {

/// Attachment outlines and surface fibres of the request into the muscles of those names; step: called before each file.
void load_muscle_files(Scene& scene, const SceneRequest& request, const std::function<void()>& step,
                       std::vector<std::string>& notes);

/// The unit of a scene (choose_units): meshes of files that state another one are converted, and no longer what their file holds (no hash).
/// Notes on units and frames. sources: one a mesh.
void settle_units(const std::vector<MeshPtr*>& meshes, const std::vector<MeshSource*>& sources,
                  std::optional<LengthUnit> wanted, LengthUnit& unit, std::vector<std::string>& notes);

/// The same of a muscle's superficial fibres, in a scene whose unit is settled. Error when they are more than 50 times larger or smaller than
/// the muscle.
void settle_fibre_unit(Muscle& muscle, LengthUnit unit, std::vector<std::string>& notes);

/// Error (usage) when two meshes have one name.
void require_unique_names(const Scene& scene);

} // namespace fascicle::io
