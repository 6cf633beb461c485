#pragma once
// The bones of a model: mesh files that it names, found beside it.

#include "fascicle/anatomy/line_model.hpp"
#include "fascicle/geometry/tri_mesh.hpp"

#include <filesystem>
#include <map>
#include <memory>
#include <optional>

namespace fascicle::io {

/// Where OpenSim looks: an absolute name as it stands; else in the model's folder, in its folder Geometry, and in Geometry of
/// $OPENSIM_HOME. The name may have folders in front, which are tried first and then left out, with \ for / and in any case
/// (models of Windows). Only regular files count whose
/// extension is that of a mesh format.
std::optional<std::filesystem::path> find_model_mesh(const std::filesystem::path& model,
                                                     const std::string& name);

/// Mesh files of one model: each is looked for and read once, however often the model names it.
class ModelMeshes {
public:
    explicit ModelMeshes(std::filesystem::path model) : model_(std::move(model)) {}

    struct Part {
        std::string name; ///< of the file
        TriMesh mesh;
    };
    /// Null when the file is not there. Adds what the reader says to `notes`, the first time. Error naming a file that is no mesh.
    std::shared_ptr<const Part> find(const std::string& name, std::vector<std::string>& notes);
    /// Counts a use of the part by a body, of which so much is there already. Error naming model, body and file when
    /// the body gets more than most_in_body points or triangles, or all bodies more than most_in_all.
    void use(const Part& part, const Body& body, const TriMesh& so_far);

    static constexpr std::size_t most_in_body = 5'000'000, most_in_all = 20'000'000;
    const std::filesystem::path& model() const { return model_; }

private:
    std::filesystem::path model_;
    std::map<std::string, std::optional<std::filesystem::path>> found_; ///< by name in the model
    std::map<std::filesystem::path, std::shared_ptr<const Part>> parts_;
    std::size_t points_ = 0, triangles_ = 0; ///< of all bodies
};

/// All meshes of a body as one, in its frame, metres; turned faces of mirrored ones (scale factors of an odd number of minus signs) are
/// turned back. missing: names of files that are not there. Nothing when no file is there. Errors of ModelMeshes.
struct BodyBone {
    TriMesh mesh;
    std::vector<std::string> files; ///< that were read
};
std::optional<BodyBone> read_body_bone(ModelMeshes& meshes, const Body& body,
                                       std::vector<std::string>& missing, std::vector<std::string>& notes);

} // namespace fascicle::io
