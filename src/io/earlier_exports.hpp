#pragma once
// What an earlier run left in a folder beside its tables and frames.

#include <cstdint>
#include <filesystem>
#include <set>
#include <vector>

namespace fascicle::io {

/// A file as it was when it had been written.
struct ExportedFile {
    std::filesystem::path file; ///< relative to the run's folder
    std::uintmax_t bytes = 0;
    long long written = 0; ///< when, in the clock of the file system
};
ExportedFile exported_file(const std::filesystem::path& folder, const std::filesystem::path& file);

/// The files that the run in a folder says it has exported (`exports` in its summary.json), relative to the folder: those that are
/// there as they were written, as regular files in folders of their own rather than behind links. None where there is no run, or a
/// damaged summary.
std::vector<std::filesystem::path> earlier_exports(const std::filesystem::path& folder);

/// Removes those of the files that are not in `written` (relative, too), and the folders that are empty then; none when one of them is an
/// input, which may need the others. No error: who keeps a file from us keeps the file.
void remove_exports(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& files,
                    const std::set<std::filesystem::path>& written,
                    const std::set<std::filesystem::path>& inputs);

} // namespace fascicle::io
