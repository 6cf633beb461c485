#pragma once
// Meshes from files into the scene.

#include "fascicle/document/document.hpp"
#include "fascicle/io/mesh_file.hpp"

#include <optional>

namespace fascicle::actions {

enum class MeshRole { bone, muscle };

/// Adds a mesh that was read from `path` and is named after it; coordinates are multiplied by `scale` > 0 (1000 for
/// metres into millimetres). A bone that is `moving` turns with the timeline's joint. One undo step; returns the index.
/// Error naming the file when the surface cannot be what it is to be; the document is then as it was.
int add_mesh(Document& document, MeshRole role, const std::filesystem::path& path, const MeshFile& file,
             double scale = 1, bool moving = false);

/// Unit of a mesh as its size suggests, for people: a box diagonal below 5 means metres, up to 5000 millimetres;
/// larger or empty: nothing.
std::optional<LengthUnit> guess_unit(const TriMesh& mesh);

} // namespace fascicle::actions
