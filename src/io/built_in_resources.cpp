#include "io/built_in_resources.hpp"

namespace fascicle::io {

std::span<const BuiltInFile> built_in_preset_files() {
    static constexpr BuiltInFile files[] = {
#include "built_in_presets.inc"
    };
    return files;
}

std::span<const BuiltInFile> built_in_lesson_files() {
    static constexpr BuiltInFile files[] = {
#include "built_in_lessons.inc"
    };
    return files;
}

} // namespace fascicle::io
