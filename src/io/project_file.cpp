#include "fascicle/io/project_file.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/io/fibre_template_file.hpp"
#include "fascicle/io/files.hpp"
#include "io/project_json.hpp"

namespace fascicle {
namespace fs = std::filesystem;

namespace io {

Json parse_project(const std::string& text, const fs::path& file) {
    Json json = parse_json_object(text, file.string());
    const JsonFields fields(json, file.string(), "");
    if (!fields.has("fascicle_project"))
        throw_error(file.string(), "not a project file", "a field fascicle_project");
    if (const int version = fields.integer("fascicle_project", 0); version < 1 || version > project_version)
        throw_error(file.string(), "project version " + std::to_string(version) + " is not known",
                    "1 to " + std::to_string(project_version) + "; a newer fascicle may read it");
    return json;
}

} // namespace io

Project read_project_file(const fs::path& path, int threads, const JobControl& control) {
    return read_project_file(path, threads, control, {});
}

Project read_project_file(const fs::path& path, int threads, const JobControl& control,
                          const LocatedFiles& located) {
    return read_project_text(read_file(path), path, threads, control, located);
}

Project read_project_text(std::string text, const fs::path& path, int threads, const JobControl& control,
                          const LocatedFiles& located) {
    Project project;
    project.text = std::move(text);
    const io::Json json = io::parse_project(project.text, path);
    const io::JsonFields fields(json, path.string(), "");
    io::ProjectReader(fields, path, threads, control, located).read(project.scene, project.notes);
    project.carry_meshes = fields.flag("carries_meshes", false);
    // Part of the program: nobody owns them.
    project.scene.fibre_templates = std::shared_ptr<const std::vector<FibreTemplate>>(
        std::shared_ptr<void>(), &built_in_fibre_templates());
    return project;
}

bool carries_meshes(const std::string& text) {
    try {
        const io::Json json = io::parse_json_object(text, "project");
        return io::JsonFields(json, "project", "").flag("carries_meshes", false);
    } catch (const Error&) {
        return false;
    }
}

std::vector<MissingFile> missing_project_files(const fs::path& path, const LocatedFiles& located) {
    const io::Json json = io::parse_project(read_file(path), path);
    const io::JsonFields fields(json, path.string(), "");
    const fs::path folder = fs::absolute(path).parent_path();
    std::vector<MissingFile> missing;
    const auto look = [&](const io::JsonFields& entry, const std::string& what) {
        if (!entry.has("path"))
            return;
        const fs::path file = (folder / entry.text("path")).lexically_normal();
        std::error_code ignored;
        if (fs::exists(file, ignored) || located.count(file) != 0)
            return;
        for (const MissingFile& known : missing)
            if (known.path == file)
                return;
        missing.push_back({file, what, entry.text("hash")});
    };
    for (const io::JsonFields& bone : fields.objects("bones"))
        look(bone, "bone " + bone.text("name"));
    for (const io::JsonFields& muscle : fields.objects("muscles")) {
        const std::string name = muscle.text("name");
        look(muscle, "muscle " + name);
        for (const io::JsonFields& file : muscle.objects("outline_files"))
            look(file, "attachments of " + name);
        if (muscle.has("surface_fibres"))
            look(muscle.object("surface_fibres"), "fibres of " + name);
        if (muscle.has("fibre_template"))
            look(muscle.object("fibre_template"), "fibre template of " + name);
    }
    if (fields.has("opensim")) {
        const io::JsonFields opensim = fields.object("opensim");
        for (const char* part : {"model", "trial"})
            if (opensim.has(part))
                look(opensim.object(part), std::string("OpenSim ") + part);
    }
    if (fields.has("line_muscles"))
        look(fields.object("line_muscles"), "line muscles");
    return missing;
}

std::string project_text(const fs::path& path, const Scene& scene, const ProjectSaving& saving) {
    io::Json previous = io::Json::object();
    if (!saving.previous_text.empty())
        previous = io::parse_json_object(saving.previous_text, path.string());
    return io::project_json(scene, path, previous, saving.carry_meshes)
               .dump(2, ' ', false, io::Json::error_handler_t::replace) +
           "\n";
}

void write_project_file(const fs::path& path, const Scene& scene, const ProjectSaving& saving) {
    write_document(path, project_text(path, scene, saving));
}

void write_project_file(const fs::path& path, const Scene& scene, const std::string& previous_text) {
    write_project_file(path, scene, ProjectSaving{previous_text, false});
}

} // namespace fascicle
