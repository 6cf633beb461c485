#pragma once
// The bones of a model: mesh files that it names, found beside it.

#include "fascicle/anatomy/line_model.hpp"
#include "fascicle/geometry/tri_mesh.hpp"

#include <filesystem>
#include <optional>

namespace fascicle::io {

/// Where OpenSim looks: an absolute name as it stands; else in the model's folder, in its folder Geometry, and in Geometry of
/// $OPENSIM_HOME. The name may have folders in front, which are tried first and then left out, with \ for / and in any case
/// (models of Windows). Only regular files count whose
/// extension is that of a mesh format.
std::optional<std::filesystem::path> find_model_mesh(const std::filesystem::path& model,
                                                     const std::string& name);

/// All meshes of a body as one, in its frame, metres; turned faces of mirrored ones (scale factors of an odd number of minus signs) are
/// turned back. missing: names of files that are not there. Nothing when no file is there. Error naming a file that is no mesh.
struct BodyBone {
    TriMesh mesh;
    std::vector<std::string> files; ///< that were read
};
std::optional<BodyBone> read_body_bone(const std::filesystem::path& model, const Body& body,
                                       std::vector<std::string>& missing, std::vector<std::string>& notes);

} // namespace fascicle::io
