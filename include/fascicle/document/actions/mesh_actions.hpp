#pragma once
// Meshes from files into the scene.

#include "fascicle/document/document.hpp"
#include "fascicle/io/mesh_file.hpp"

#include <optional>

namespace fascicle::actions {

enum class MeshRole { bone, muscle };

/// A mesh on its way into the scene.
struct NewMesh {
    std::filesystem::path path; ///< of its file
    std::string name;           ///< empty: the file's, without extension
    MeshRole role = MeshRole::bone;
    bool moving = false; ///< of a bone: turns with the timeline's joint
    MeshPtr mesh;        ///< in scene units and axes; not null
    std::string hash;    ///< of the file's bytes, when the mesh is what the file holds; else empty
    MeshReport report;   ///< of the mesh: checking a large one takes too long for the thread of an interface
};

/// Adds all in one undo step, "Add bone femur" or "Add 3 meshes"; names that are taken get a number behind them. Error naming the file when a
/// surface cannot be what it is to be; the document is then as it was. Nothing, and no step, for an empty list.
void add_meshes(Document& document, const std::vector<NewMesh>& meshes);

/// Unit of a mesh as its size suggests, for people: a box diagonal below 5 means metres, up to 5000 millimetres;
/// larger or empty: nothing.
std::optional<LengthUnit> guess_unit(const TriMesh& mesh);

} // namespace fascicle::actions
