#include "io/earlier_exports.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/io/files.hpp"
#include "io/json_fields.hpp"

namespace fascicle::io {
namespace fs = std::filesystem;

namespace {

constexpr std::size_t most_bytes = std::size_t{64} << 20; // of a summary

/// Whether a path of the summary leads to a file of that folder: it may have been written by anybody.
bool is_inside(const fs::path& folder, const fs::path& file) {
    if (file.empty() || file.is_absolute() || file != file.lexically_normal() || *file.begin() == "..")
        return false;
    std::error_code error;
    for (fs::path parent = file.parent_path(); !parent.empty(); parent = parent.parent_path())
        if (!fs::is_directory(fs::symlink_status(folder / parent, error)))
            return false;
    return fs::is_regular_file(fs::symlink_status(folder / file, error));
}

} // namespace

ExportedFile exported_file(const fs::path& folder, const fs::path& file) {
    std::error_code error;
    ExportedFile result{file, fs::file_size(folder / file, error), 0};
    result.written =
        static_cast<long long>(fs::last_write_time(folder / file, error).time_since_epoch().count());
    return result;
}

std::vector<fs::path> earlier_exports(const fs::path& folder) {
    std::vector<fs::path> files;
    try {
        std::error_code error;
        if (!fs::is_regular_file(folder / "summary.json", error))
            return files;
        const fs::path path = folder / "summary.json";
        const Json summary = parse_json_object(read_file(path, most_bytes), path.string());
        const auto list = summary.find("exports");
        if (list == summary.end() || !list->is_array())
            return files;
        for (const Json& entry : *list)
            if (entry.is_object() && entry.value("file", Json()).is_string() &&
                entry.value("bytes", Json()).is_number_unsigned() &&
                entry.value("written", Json()).is_number_integer()) {
                const fs::path file = entry["file"].get<std::string>();
                if (!is_inside(folder, file))
                    continue;
                const ExportedFile now = exported_file(folder, file);
                if (now.bytes == entry["bytes"].get<std::uintmax_t>() && // else it has become somebody's own
                    now.written == entry["written"].get<long long>())
                    files.push_back(file);
            }
    } catch (const Error&) { // not to be read: nothing is known of it
        files.clear();
    }
    return files;
}

void remove_exports(const fs::path& folder, const std::vector<fs::path>& files,
                    const std::set<fs::path>& written, const std::set<fs::path>& inputs) {
    std::error_code ignored;
    const auto is_input = [&](const fs::path& file) {
        for (const fs::path& input : inputs)
            if (fs::equivalent(input, file, ignored))
                return true;
        return false;
    };
    for (const fs::path& file : files)
        if (is_input(folder / file))
            return;
    for (const fs::path& file : files) {
        if (written.count(file) > 0)
            continue;
        fs::remove(folder / file, ignored);
        for (fs::path parent = file.parent_path(); !parent.empty(); parent = parent.parent_path())
            if (!fs::is_empty(folder / parent, ignored) || !fs::remove(folder / parent, ignored))
                break;
    }
}

} // namespace fascicle::io
