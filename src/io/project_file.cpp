#include "fascicle/io/project_file.hpp"

#include "fascicle/base/build_info.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/io/files.hpp"
#include "io/project_json.hpp"

namespace fascicle {
namespace fs = std::filesystem;

Project read_project_file(const fs::path& path, int threads, const JobControl& control) {
    Project project;
    project.text = read_file(path);
    const io::Json json = io::parse_json_object(project.text, path.string());
    const io::JsonFields fields(json, path.string(), "");
    if (!fields.has("fascicle_project"))
        throw_error(path.string(), "not a project file", "a field fascicle_project");
    if (const int version = fields.integer("fascicle_project", 0);
        version < 1 || version > io::project_version)
        throw_error(path.string(), "project version " + std::to_string(version) + " is not known",
                    "1 to " + std::to_string(io::project_version) + "; a newer fascicle may read it");
    io::ProjectReader(fields, path, threads, control).read(project.scene, project.notes);
    return project;
}

void write_project_file(const fs::path& path, const Scene& scene, const std::string& previous_text) {
    io::Json previous = io::Json::object();
    if (!previous_text.empty())
        previous = io::parse_json_object(previous_text, path.string());
    write_file(
        path,
        io::project_json(scene, path, previous).dump(2, ' ', false, io::Json::error_handler_t::replace) +
            "\n");
}

} // namespace fascicle
