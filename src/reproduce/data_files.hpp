#pragma once
// The public data, wherever a user keeps it: files are found by their names.

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace fascicle::reproduce {

/// Names of files below a folder.
class DataFiles {
public:
    DataFiles() = default;
    /// Reads the names of all files in the folder and its sub-folders (at most 12 deep, hidden ones left out; what cannot be read is
    /// passed over). Error (usage) when it is no folder.
    explicit DataFiles(const std::filesystem::path& folder);

    /// The file of this name. Of several the one with the shortest path below the folder, of equally short ones the first in alphabetical
    /// order. Nothing when there is none.
    std::optional<std::filesystem::path> find(const std::string& name) const;
    bool empty() const { return files_.empty(); }

private:
    std::map<std::string, std::filesystem::path> files_;
};

/// $FASCICLE_DATA, else ../shared/data, when that is a folder.
std::optional<std::filesystem::path> default_data_folder();

} // namespace fascicle::reproduce
