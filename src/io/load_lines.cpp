// Line muscles of a model file into a scene.
#include "fascicle/base/state_hash.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/load_scene.hpp"
#include "fascicle/io/osim_file.hpp"
#include "fascicle/scene/line_muscles.hpp"

namespace fascicle {

void load_line_muscles(Scene& scene, const std::filesystem::path& path, std::vector<std::string>& notes) {
    const std::string bytes = read_file(path);
    OsimModel file = read_osim(bytes, path.string());
    for (const std::string& note : file.notes)
        notes.push_back(path.filename().string() + ": " + note);
    LineMuscles lines = place_line_muscles(std::make_shared<const LineModel>(std::move(file.model)), scene,
                                           path.string(), notes);
    StateHash hash;
    hash.add_bytes(bytes.data(), bytes.size());
    lines.source = {path.string(), hash.hex()};
    scene.line_muscles = std::make_shared<const LineMuscles>(std::move(lines));
}

} // namespace fascicle
