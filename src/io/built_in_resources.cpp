#include "io/built_in_resources.hpp"

#if !__has_include("built_in_presets.inc") // a quick build without CMake: from the source folder
#include "fascicle/io/files.hpp"

#include <deque>
#include <string>
#include <vector>
#endif

namespace fascicle::io {

#if __has_include("built_in_presets.inc")

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

#else

namespace {

std::vector<BuiltInFile> read_folder(const std::string& folder, std::initializer_list<const char*> names) {
    static std::deque<std::string> kept; // the views need them
    std::vector<BuiltInFile> files;
    for (const char* name : names) {
        kept.push_back(read_file(std::string(FASCICLE_SOURCE_DIR) + "/resources/" + folder + "/" + name));
        files.push_back({name, kept.back()});
    }
    return files;
}

} // namespace

std::span<const BuiltInFile> built_in_preset_files() {
    static const auto files =
        read_folder("presets", {"paper.json", "soft.json", "stiff.json", "isotropic.json"});
    return files;
}

std::span<const BuiltInFile> built_in_lesson_files() {
    static const auto files = read_folder("lessons", {"volume.json", "local-shape.json", "anisotropy.json",
                                                      "contact.json", "moment-arm.json", "quiz.json"});
    return files;
}

#endif

} // namespace fascicle::io
