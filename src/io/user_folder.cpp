#include "fascicle/io/user_folder.hpp"

#include <cstdlib>

namespace fascicle {

std::filesystem::path user_folder() {
    if (const char* own = std::getenv("FASCICLE_USER"); own != nullptr)
        return own;
    if (const char* data = std::getenv("XDG_DATA_HOME"); data != nullptr && data[0] == '/')
        return std::filesystem::path(data) / "fascicle";
    if (const char* home = std::getenv("HOME"); home != nullptr && home[0] == '/')
        return std::filesystem::path(home) / ".local/share/fascicle";
    return {};
}

} // namespace fascicle
