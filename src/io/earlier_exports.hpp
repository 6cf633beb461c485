#pragma once
// What an earlier run left in a folder beside its tables and frames.

#include <filesystem>
#include <set>
#include <vector>

namespace fascicle::io {

/// The files that the run in a folder says it has exported (`exports` in its summary.json), relative to the folder: those that are
/// there as regular files, in folders of their own rather than behind links. None where there is no run, or a damaged summary.
std::vector<std::filesystem::path> earlier_exports(const std::filesystem::path& folder);

/// Removes those of the files that are neither in `written` (relative, too) nor an input, and the folders that are empty then. No
/// error: who keeps a file from us keeps the file.
void remove_exports(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& files,
                    const std::set<std::filesystem::path>& written,
                    const std::set<std::filesystem::path>& inputs);

} // namespace fascicle::io
