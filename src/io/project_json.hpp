#pragma once
// The JSON of project files, in both directions.

#include "fascicle/geometry/mesh_check.hpp"
#include "fascicle/io/project_file.hpp"
#include "io/json_fields.hpp"

namespace fascicle::io {

/// 2 added carried meshes, fibres and templates, markers and defaults of the scene.
inline constexpr int project_version = 2;

/// The scene as JSON; paths relative to the folder of `file`. Fields of `previous` that this version does not know are kept
/// (project_unknown.hpp).
Json project_json(const Scene& scene, const std::filesystem::path& file, const Json& previous,
                  bool carry_meshes);

/// Hash of a mesh's numbers: tells which mesh of an embedded scene is meant, whatever it is called now.
std::string mesh_hash(const TriMesh& mesh);

/// The object of a project file, of a version that is known.
Json parse_project(const std::string& text, const std::filesystem::path& file);

/// The field `kind` of an outline, attachment or area.
AttachmentKind kind_of(const JsonFields& entry);

class ProjectReader {
public:
    ProjectReader(const JsonFields& fields, const std::filesystem::path& file, int threads,
                  const JobControl& control, const LocatedFiles& located);
    void read(Scene& scene, std::vector<std::string>& notes);

private:
    struct EmbeddedThing {
        MeshPtr mesh;
        std::shared_ptr<const Polylines> fibres;
    };
    void make_embedded(Scene& scene);
    std::filesystem::path resolved(const JsonFields& entry) const;
    /// A note when the file is not the one that the project was saved with.
    void compare(const JsonFields& entry, const MeshSource& source);
    /// Of the embedded scene with the hash in the entry, else of its name; null when there is none.
    const EmbeddedThing* embedded_thing(const JsonFields& entry, const char* kind);
    /// The mesh of an entry without a path, checked by `check`.
    MeshPtr inner_mesh(const JsonFields& entry, const char* kind,
                       void (*check)(const MeshReport&, const std::string&));
    Bone bone(const JsonFields& entry);
    Muscle muscle(const JsonFields& entry, const Scene& scene);
    void outlines(const JsonFields& entry, Muscle& muscle, const Scene& scene);
    void fibres(const JsonFields& entry, Muscle& muscle);
    std::vector<Attachment> attachments(const JsonFields& entry, const Muscle& muscle, const Scene& scene);
    std::vector<AttachmentArea> areas(const JsonFields& entry, const Scene& scene);
    void timeline(const JsonFields& entry, Scene& scene);
    void markers(Scene& scene);
    void opensim(const JsonFields& entry, Scene& scene);
    void parameters(const JsonFields& entry, Scene& scene);

    const JsonFields& fields_;
    std::filesystem::path file_, folder_;
    int threads_;
    const JobControl& control_;
    const LocatedFiles& located_;
    int version_ = project_version;
    std::vector<std::string>* notes_ = nullptr;
    std::map<std::string, EmbeddedThing> embedded_; ///< by hash, and by "bone NAME" or "muscle NAME"
};

} // namespace fascicle::io
