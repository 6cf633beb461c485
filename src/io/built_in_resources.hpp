#pragma once
// The files of resources/presets and resources/lessons, put into the program by CMake.

#include "io/built_in_templates.hpp"

namespace fascicle::io {

std::span<const BuiltInFile> built_in_preset_files();
std::span<const BuiltInFile> built_in_lesson_files();

} // namespace fascicle::io
