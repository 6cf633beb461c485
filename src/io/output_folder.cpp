#include "fascicle/io/output_folder.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/scene/line_muscles.hpp"
#include "fascicle/scene/model_motion.hpp"
#include "io/run_files.hpp"

#include <set>

namespace fascicle {
namespace fs = std::filesystem;

const fs::path& without_inputs(const fs::path& folder, const Scene& scene) {
    std::set<fs::path> outputs;
    const auto canonical = [](const fs::path& path) {
        std::error_code code;
        const fs::path found = fs::weakly_canonical(path, code);
        return code ? path : found;
    };
    for (const char* name :
         {"summary.json", "metrics.csv", "motion.csv", "fibres.csv", "lines.csv", "architecture.csv"})
        outputs.insert(canonical(folder / name));
    for (const Bone& bone : scene.bones)
        outputs.insert(canonical(folder / io::bone_file(bone.name)));
    for (const Muscle& muscle : scene.muscles)
        outputs.insert(canonical(folder / io::series_file(muscle.name)));
    const auto check = [&](const MeshSource& source) {
        if (source.path.empty())
            return;
        const fs::path path = canonical(source.path);
        bool clash = outputs.count(path) > 0;
        for (const Muscle& muscle : scene.muscles)
            clash = clash || ((path.parent_path() == canonical(folder / "frames") ||
                               path.parent_path() == canonical(folder / "fibres")) &&
                              io::frame_of_file(path, muscle.name) >= 0);
        if (clash)
            throw_error(folder.string(), "the output would replace the input " + source.path,
                        "another output folder", ErrorKind::usage);
    };
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
    return folder;
}

} // namespace fascicle
