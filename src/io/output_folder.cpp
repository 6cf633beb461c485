#include "fascicle/io/output_folder.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/base/text.hpp"
#include "fascicle/scene/line_muscles.hpp"
#include "fascicle/scene/model_motion.hpp"
#include "io/run_files.hpp"

#include <map>
#include <set>

namespace fascicle {
namespace fs = std::filesystem;

namespace {

fs::path resolved(const fs::path& path) {
    std::error_code code;
    const fs::path found = fs::weakly_canonical(path, code);
    return code ? path : found;
}

/// Calls check(source) for every file that the scene was read from.
template <typename Check>
void for_each_input(const Scene& scene, const std::vector<fs::path>& more_inputs, const Check& check_source) {
    const auto check = [&](const MeshSource& source) {
        if (!source.path.empty())
            check_source(source);
    };
    for (const fs::path& input : more_inputs)
        check({input.string(), {}});
    check(scene.motion_source);
    if (scene.model_motion != nullptr)
        check(scene.model_motion->model_source);
    if (scene.line_muscles != nullptr)
        check(scene.line_muscles->source);
    for (const Bone& bone : scene.bones)
        check(bone.source);
    for (const Muscle& muscle : scene.muscles) {
        check(muscle.source);
        check(muscle.surface_fibres_source);
        check(muscle.fibre_template_source);
        for (const MeshSource& source : muscle.outline_files)
            check(source);
    }
}

} // namespace

void require_file_names(const Scene& scene) {
    std::map<std::string, std::string> names; // of files, and whose
    const auto add = [&](const std::string& name) {
        const auto [it, is_new] = names.emplace(file_name_for(name), name);
        if (!is_new)
            throw_error("", "the names '" + it->second + "' and '" + name + "' would call the same file",
                        "names that differ in more than separators");
    };
    for (const Bone& bone : scene.bones)
        add(bone.name);
    for (const Muscle& muscle : scene.muscles)
        add(muscle.name);
}

const fs::path& without_inputs(const fs::path& folder, const Scene& scene,
                               const std::vector<fs::path>& more_inputs) {
    require_file_names(scene);
    std::set<fs::path> outputs;
    for (const char* name :
         {"summary.json", "metrics.csv", "motion.csv", "fibres.csv", "lines.csv", "architecture.csv"})
        outputs.insert(resolved(folder / name));
    for (const Bone& bone : scene.bones)
        outputs.insert(resolved(folder / io::bone_file(bone.name)));
    for (const Muscle& muscle : scene.muscles)
        outputs.insert(resolved(folder / io::series_file(muscle.name)));
    for_each_input(scene, more_inputs, [&](const MeshSource& source) {
        const fs::path path = resolved(source.path);
        bool clash = outputs.count(path) > 0;
        for (const Muscle& muscle : scene.muscles)
            clash = clash || ((path.parent_path() == resolved(folder / "frames") ||
                               path.parent_path() == resolved(folder / "fibres")) &&
                              io::frame_of_file(path, muscle.name) >= 0);
        if (clash)
            throw_error(folder.string(), "the output would replace the input " + source.path,
                        "another output folder", ErrorKind::usage);
    });
    return folder;
}

} // namespace fascicle
