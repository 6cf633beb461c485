#pragma once
// Project files (.fascicle): JSON that names the sources of a scene, or carries them, and holds everything else of it.
// docs/formats.md and resources/project.schema.json describe them.

#include "fascicle/base/job_control.hpp"
#include "fascicle/io/load_scene.hpp"

#include <map>

namespace fascicle {

/// Reads the sources that the file names (paths relative to its folder), then the timeline, attachments and parameters.
/// A source whose bytes are no longer those of the project gives a note, not an error. `text` is the file as it was:
/// hand it to write_project_file so that fields which this version does not know survive.
struct Project {
    Scene scene;
    std::vector<std::string> notes;
    std::string text;
    bool carry_meshes = false; ///< it was saved with all meshes inside
};
Project read_project_file(const std::filesystem::path& path, int threads = 1, const JobControl& control = {});

/// Project::carry_meshes of a project's text; false when that is no project.
bool carries_meshes(const std::string& text);

/// Where files are now that a project names in another place: MissingFile::path to the file that is to be read.
using LocatedFiles = std::map<std::filesystem::path, std::filesystem::path>;
Project read_project_file(const std::filesystem::path& path, int threads, const JobControl& control,
                          const LocatedFiles& located);
/// The same from the text of the project at `path`, which is not read.
Project read_project_text(std::string text, const std::filesystem::path& path, int threads = 1,
                          const JobControl& control = {}, const LocatedFiles& located = {});

/// A file that a project needs and that is not where it says.
struct MissingFile {
    std::filesystem::path path; ///< absolute
    std::string what;           ///< "bone femur", "fibres of gluteus_maximus"
    std::string hash;           ///< StateHash of its bytes when the project was saved; may be empty
};
/// Those that are not in `located` either, each once. Reads nothing but the project. Error when that is no project.
std::vector<MissingFile> missing_project_files(const std::filesystem::path& path,
                                               const LocatedFiles& located = {});

/// Any scene can be written: a mesh (outline, fibre, template) that comes from no file, was changed since it was read (empty
/// MeshSource::hash), or whose file is no longer what was read, is carried inside. The file is flushed to the disk before it
/// gets its name. Error when it cannot be written; what was there then stays.
void write_project_file(const std::filesystem::path& path, const Scene& scene,
                        const std::string& previous_text = {});

struct ProjectSaving {
    std::string previous_text{}; ///< Project::text
    bool carry_meshes = false;   ///< all meshes inside: the file needs no other
};
void write_project_file(const std::filesystem::path& path, const Scene& scene, const ProjectSaving& saving);
/// What would be written to `path`.
std::string project_text(const std::filesystem::path& path, const Scene& scene, const ProjectSaving& saving);

} // namespace fascicle
