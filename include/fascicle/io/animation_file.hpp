#pragma once
// Animations as files of other programs: one row a format, for what is written and what is read back.

#include "fascicle/io/animation.hpp"

#include <filesystem>

namespace fascicle {

struct AnimationOptions {
    int morph_targets = 64; ///< glTF: at most, 1 or more
};

struct AnimationFormat {
    const char* key;       ///< "glb"
    const char* name;      ///< shown to people
    const char* extension; ///< of the file, or of each file that stands for all (`NAME.pvd`)
    bool folder;           ///< several files: the target is a folder
    bool even_frames;      ///< frames lie at equal distances: there is no place for their numbers
    /// From one file, with those that it names or that belong to it. Error naming the file and the place.
    Animation (*read)(const std::filesystem::path& path);
    /// A file, complete or not there; or files in a folder, each complete or not there. Error naming the file; Cancelled.
    void (*write)(const std::filesystem::path& target, const Animation& animation,
                  const AnimationOptions& options, const JobControl& control);
};

const std::vector<AnimationFormat>& animation_formats();
/// Null when there is none.
const AnimationFormat* find_animation_format(std::string_view key);

/// The format that a file would be read in: glTF and USD by content, the others by extension; an OBJ counts when its name ends with a number
/// and there is another one of the series. Null for what is no animation.
const AnimationFormat* recognise_animation(const std::filesystem::path& path);
/// Error when the file is none.
Animation read_animation(const std::filesystem::path& path);

/// Whether frames lie at equal distances.
bool evenly_spaced(const std::vector<int>& frames);

} // namespace fascicle
