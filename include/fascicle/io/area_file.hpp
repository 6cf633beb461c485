#pragma once
// Attachment areas to and from files: as outlines in a CSV, and as point arrays of a bone's mesh.

#include "fascicle/io/mesh_data.hpp"
#include "fascicle/scene/outline_areas.hpp"

#include <filesystem>
#include <string_view>

namespace fascicle {

/// The borders of the muscle's areas as a table: attachment,bone,head,loop,hole,x_mm,y_mm,z_mm, read back by read_attachments and
/// areas_from_outlines. Error naming muscle and area when an area has no border (it covers all of a closed surface). A note when the borders
/// do not give an area back to the vertex: a region with both sides as large as the rest (a belt) cannot be told by outlines.
std::string area_outlines_csv(const Scene& scene, const Muscle& muscle, BoneSurfaces& surfaces,
                              std::vector<std::string>& notes);
void write_area_outlines(const std::filesystem::path& path, const Scene& scene, const Muscle& muscle,
                         BoneSurfaces& surfaces, std::vector<std::string>& notes);

/// The bone's mesh with one point array for each muscle that has an area on it, named "attachment:MUSCLE", values as in
/// area_labels; with `only` (a muscle's index) its array alone, named "attachment". To be written as .vtp or .vtk.
MeshData area_mesh(const Scene& scene, int bone, int only = -1);

/// Areas of a muscle from such a mesh: the array "attachment:MUSCLE", else "attachment". The mesh must be the bone's: as many
/// vertices, each within 1e-4 of the bone's size of its place (text formats round). Error naming file and array otherwise.
std::vector<AttachmentArea> areas_from_mesh(const MeshData& mesh, const std::string& file, const Scene& scene,
                                            int bone, const std::string& muscle_name);
std::vector<AttachmentArea> read_area_mesh(const std::filesystem::path& path, const Scene& scene, int bone,
                                           const std::string& muscle_name);

/// The area of a patch mesh in a file (area_from_patch), tolerance in scene units. Error when the patch lies nowhere on the bone.
SurfaceRegion read_area_patch(const std::filesystem::path& path, const Bone& bone, BoneSurfaces& surfaces,
                              double tolerance);

} // namespace fascicle
