#pragma once
// Project files (.fascicle): JSON that names the sources of a scene and holds everything else of it.

#include "fascicle/base/job_control.hpp"
#include "fascicle/io/load_scene.hpp"

namespace fascicle {

/// Reads the sources that the file names (paths relative to its folder), then the timeline, attachments and parameters.
/// A source whose bytes are no longer those of the project gives a note, not an error. `text` is the file as it was:
/// hand it to write_project_file so that fields which this version does not know survive.
struct Project {
    Scene scene;
    std::vector<std::string> notes;
    std::string text;
};
Project read_project_file(const std::filesystem::path& path, int threads = 1, const JobControl& control = {});

/// Error when the scene has a mesh that comes from no file and no embedded scene, or the file cannot be written.
void write_project_file(const std::filesystem::path& path, const Scene& scene,
                        const std::string& previous_text = {});

} // namespace fascicle
