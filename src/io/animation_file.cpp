#include "fascicle/io/animation_file.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/io/files.hpp"
#include "io/formats/animation_series.hpp"
#include "io/formats/gltf_read.hpp"
#include "io/formats/gltf_write.hpp"
#include "io/formats/text_scanner.hpp"
#include "io/formats/usda_read.hpp"
#include "io/formats/usda_write.hpp"

#include <fstream>

namespace fascicle {
namespace fs = std::filesystem;

namespace {

constexpr std::size_t most_shapes = 10'000'000;

void write_glb_file(const fs::path& target, const Animation& animation, const AnimationOptions& options,
                    const JobControl& control) {
    AtomicFile file(target);
    io::write_glb(file.stream(), animation, {options.morph_targets}, target.string(), control);
    file.commit();
}

Animation read_glb_file(const fs::path& path) {
    return io::read_glb(read_file(path), path.string());
}

void write_usda_file(const fs::path& target, const Animation& animation, const AnimationOptions&,
                     const JobControl& control) {
    AtomicFile file(target);
    io::write_usda(file.stream(), animation, control);
    file.commit();
}

Animation read_usda_file(const fs::path& path) {
    return io::read_usda(read_file(path), path.string());
}

} // namespace

const std::vector<AnimationFormat>& animation_formats() {
    static const std::vector<AnimationFormat> rows{
        {"glb", "glTF 2.0", ".glb", false, false, read_glb_file, write_glb_file},
        {"usda", "USD text", ".usda", false, false, read_usda_file, write_usda_file},
        {"obj", "OBJ sequence", ".obj", true, false, io::read_obj_series, io::write_obj_series},
        {"pc2", "PC2 point cache", ".pc2", true, true, io::read_pc2_file, io::write_pc2_files},
        {"mdd", "MDD point cache", ".mdd", true, true, io::read_mdd_file, io::write_mdd_files},
        {"pvd", "ParaView series", ".pvd", true, false, io::read_vtp_series, io::write_vtp_series},
    };
    return rows;
}

const AnimationFormat* find_animation_format(std::string_view key) {
    for (const AnimationFormat& row : animation_formats())
        if (row.key == key)
            return &row;
    return nullptr;
}

const AnimationFormat* recognise_animation(const fs::path& path) {
    std::error_code error;
    if (!fs::is_regular_file(path, error))
        return nullptr;
    char head[16] = {};
    std::ifstream(path, std::ios::binary).read(head, sizeof head);
    if (io::looks_like_glb({head, sizeof head}))
        return find_animation_format("glb");
    if (io::looks_like_usda({head, sizeof head}))
        return find_animation_format("usda");
    const std::string extension = io::lower_case(path.extension().string());
    if (extension == ".obj")
        return io::is_obj_series(path) ? find_animation_format("obj") : nullptr;
    for (const AnimationFormat& row : animation_formats())
        if (extension == row.extension)
            return &row;
    return nullptr;
}

Animation read_animation(const fs::path& path) {
    if (const AnimationFormat* format = recognise_animation(path)) {
        Animation animation = format->read(path);
        // Each body is placed at each time of the file: a small one of many bodies that move at a time of their own each would be
        // written for hours, and fill the disk.
        if (animation.bodies.size() * animation.frame_count() > most_shapes)
            throw_error(path.string(),
                        std::to_string(animation.bodies.size()) + " bodies at " +
                            std::to_string(animation.frame_count()) + " times",
                        "at most 10 million shapes in all");
        return animation;
    }
    read_file(path); // says why, when it is no file
    std::string known;
    for (const AnimationFormat& row : animation_formats())
        known += (known.empty() ? "" : ", ") + std::string(row.extension);
    throw_error(path.string(), "not an animation of a known format", "one of " + known);
}

bool evenly_spaced(const std::vector<int>& frames) {
    for (std::size_t k = 2; k < frames.size(); ++k)
        if (frames[k] - frames[k - 1] != frames[1] - frames[0])
            return false;
    return true;
}

} // namespace fascicle
