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

} // namespace

std::set<fs::path> inputs_of(const Scene& scene) {
    std::set<fs::path> inputs;
    const auto add = [&](const MeshSource& source) {
        if (!source.path.empty())
            inputs.insert(source.path);
    };
    add(scene.motion_source);
    if (scene.model_motion != nullptr)
        add(scene.model_motion->model_source);
    if (scene.line_muscles != nullptr)
        add(scene.line_muscles->source);
    for (const Bone& bone : scene.bones)
        add(bone.source);
    for (const Muscle& muscle : scene.muscles) {
        add(muscle.source);
        add(muscle.surface_fibres_source);
        add(muscle.fibre_template_source);
        for (const MeshSource& source : muscle.outline_files)
            add(source);
    }
    return inputs;
}

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
    std::set<fs::path> inputs = inputs_of(scene);
    inputs.insert(more_inputs.begin(), more_inputs.end());
    for (const fs::path& input : inputs) {
        const fs::path path = resolved(input);
        bool clash = outputs.count(path) > 0;
        for (const Muscle& muscle : scene.muscles)
            clash = clash || ((path.parent_path() == resolved(folder / "frames") ||
                               path.parent_path() == resolved(folder / "fibres")) &&
                              io::frame_of_file(path, muscle.name) >= 0);
        if (clash)
            throw_error(folder.string(), "the output would replace the input " + input.string(),
                        "another output folder", ErrorKind::usage);
    }
    return folder;
}

} // namespace fascicle
