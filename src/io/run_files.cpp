#include "io/run_files.hpp"

#include "fascicle/base/text.hpp"
#include "io/formats/text_scanner.hpp"

namespace fascicle::io {

std::filesystem::path frame_file(std::string_view muscle, int frame) {
    std::string digits = std::to_string(frame);
    digits.insert(0, digits.size() < 4 ? 4 - digits.size() : 0, '0');
    return std::filesystem::path("frames") / (file_name_for(muscle) + "." + digits + ".vtp");
}

std::filesystem::path bone_file(std::string_view bone) {
    return std::filesystem::path("bones") / (file_name_for(bone) + ".vtp");
}

std::filesystem::path series_file(std::string_view muscle) {
    return file_name_for(muscle) + ".pvd";
}

int frame_of_file(const std::filesystem::path& file, std::string_view muscle) {
    const std::string name = file.filename().string();
    const std::string start = file_name_for(muscle) + ".", end = ".vtp";
    if (name.size() < start.size() + 4 + end.size() || name.compare(0, start.size(), start) != 0 ||
        name.compare(name.size() - end.size(), end.size(), end) != 0)
        return -1;
    const std::string digits = name.substr(start.size(), name.size() - start.size() - end.size());
    if (digits.size() > 9 || digits.find_first_not_of("0123456789") != std::string::npos)
        return -1;
    long long frame = -1;
    to_integer(digits, frame);
    return static_cast<int>(frame);
}

} // namespace fascicle::io
