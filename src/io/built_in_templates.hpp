#pragma once
// The files of resources/fibre_templates, put into the program by CMake.

#include <span>
#include <string_view>

namespace fascicle::io {

struct BuiltInFile {
    std::string_view name;
    std::string_view text;
};

std::span<const BuiltInFile> built_in_template_files();

} // namespace fascicle::io
