#include "reproduce/data_files.hpp"

#include "fascicle/base/error.hpp"

#include <cstdlib>

namespace fascicle::reproduce {

namespace fs = std::filesystem;

DataFiles::DataFiles(const fs::path& folder) {
    std::error_code error;
    if (!fs::is_directory(folder, error))
        throw_error("--data", "'" + folder.string() + "' is no folder",
                    "the folder that holds the public data", ErrorKind::usage);
    constexpr int deepest = 12;
    fs::recursive_directory_iterator it(folder, fs::directory_options::skip_permission_denied, error), end;
    for (; !error && it != end; it.increment(error)) {
        const fs::path& path = it->path();
        const std::string name = path.filename().string();
        std::error_code ignored;
        if (it->is_directory(ignored)) {
            if (it.depth() >= deepest || name.starts_with("."))
                it.disable_recursion_pending();
            continue;
        }
        if (!it->is_regular_file(ignored))
            continue;
        const auto [known, fresh] = files_.try_emplace(name, path);
        const std::string a = path.generic_string(), b = known->second.generic_string();
        if (!fresh && (a.size() < b.size() || (a.size() == b.size() && a < b)))
            known->second = path;
    }
}

std::optional<fs::path> DataFiles::find(const std::string& name) const {
    const auto it = files_.find(name);
    return it == files_.end() ? std::nullopt : std::optional(it->second);
}

std::optional<fs::path> default_data_folder() {
    std::error_code error;
    if (const char* set = std::getenv("FASCICLE_DATA"); set != nullptr && fs::is_directory(set, error))
        return fs::path(set);
    const fs::path beside = fs::path("..") / "shared" / "data";
    if (fs::is_directory(beside, error))
        return beside;
    return std::nullopt;
}

} // namespace fascicle::reproduce
