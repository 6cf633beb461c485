#include "io/osim_export/osim_names.hpp"

namespace fascicle::io {

std::string osim_name(std::string_view name, std::string_view otherwise) {
    std::string legal;
    for (const char c : name) {
        const auto byte = static_cast<unsigned char>(c);
        const bool keep = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                          c == '_' || c == '-' || c == '.';
        if (keep)
            legal += c;
        else if ((byte & 0xC0U) != 0x80U) // not the second byte of a character
            legal += '_';
    }
    if (legal.find_first_not_of('_') == std::string::npos)
        return std::string(otherwise);
    if (legal.front() == '.' || legal.front() == '-')
        legal.insert(0, otherwise);
    return legal;
}

std::string OsimNames::unique(std::string name) {
    std::string free = name;
    for (int k = 2; !taken_.insert(free).second; ++k)
        free = name + "_" + std::to_string(k);
    return free;
}

} // namespace fascicle::io
