#pragma once
// The JSON of project files, in both directions.

#include "fascicle/io/load_scene.hpp"
#include "io/json_fields.hpp"

#include <map>

namespace fascicle::io {

inline constexpr int project_version = 1;

/// The scene as JSON; paths relative to the folder of `file`. Fields of `previous` that this version does not know are
/// kept: at the top, in parameters, and in bones and muscles of the same name.
Json project_json(const Scene& scene, const std::filesystem::path& file, const Json& previous);

/// Hash of a mesh's numbers: tells which mesh of an embedded scene is meant, whatever it is called now.
std::string mesh_hash(const TriMesh& mesh);

class ProjectReader {
public:
    ProjectReader(const JsonFields& fields, std::filesystem::path file, int threads,
                  const JobControl& control)
        : fields_(fields), file_(std::move(file)), threads_(threads), control_(control) {}
    void read(Scene& scene, std::vector<std::string>& notes);

private:
    std::filesystem::path resolved(const JsonFields& entry) const;
    /// A note when the file is not the one that the project was saved with.
    void compare(const JsonFields& entry, const MeshSource& source);
    /// Mesh of the embedded scene with the hash in the entry, else of its name; null when there is none.
    MeshPtr embedded_mesh(const JsonFields& entry) const;
    Bone bone(const JsonFields& entry);
    Muscle muscle(const JsonFields& entry, const Scene& scene);
    std::vector<Attachment> attachments(const JsonFields& entry, const Muscle& muscle, const Scene& scene);
    std::vector<AttachmentArea> areas(const JsonFields& entry, const Scene& scene);
    void timeline(const JsonFields& entry, Scene& scene);
    void parameters(const JsonFields& entry, Scene& scene);

    const JsonFields& fields_;
    std::filesystem::path file_;
    int threads_;
    const JobControl& control_;
    std::vector<std::string>* notes_ = nullptr;
    std::map<std::string, MeshPtr> embedded_; ///< by hash, and by "bone NAME" or "muscle NAME"
};

} // namespace fascicle::io
