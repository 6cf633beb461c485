#pragma once
// Several files that appear together or not at all.

#include "fascicle/io/files.hpp"
#include "fascicle/scene/scene.hpp"

#include <filesystem>
#include <optional>
#include <set>
#include <vector>

namespace fascicle {

/// Error (usage) naming the input when `file` is a file that the scene was read from.
void check_no_input(const std::filesystem::path& file, const Scene& scene);

/// A folder that one program at a time writes to. The lock is the kernel's, on the folder itself: it ends with the program however that
/// ends, and leaves no file. Where the file system has no locks there is none.
class FolderLock {
public:
    /// Error naming the folder when another holds it.
    explicit FolderLock(const std::filesystem::path& folder);
    ~FolderLock();
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

private:
    int file_ = -1;
};

/// A hidden folder beside the final files; commit() moves what is in it, the destructor removes the rest. Hidden folders that a killed
/// program left there are removed.
class StagedFiles {
public:
    /// alone: the folder is that of a run or a series, and locked meanwhile; shared: others may write there, too.
    enum class Use { alone, shared };
    /// folder: where the files shall be, made when missing. Error naming it when it cannot be written to, or another program
    /// writes to it.
    explicit StagedFiles(std::filesystem::path folder, Use use = Use::alone);
    ~StagedFiles();
    StagedFiles(const StagedFiles&) = delete;
    StagedFiles& operator=(const StagedFiles&) = delete;

    /// Where files are to be written meanwhile, in folders of their own if need be.
    const std::filesystem::path& place() const { return place_; }
    /// Moves all files to the final folder, replacing those of the same name; summary.json, which makes a folder a run, goes first
    /// and comes last. When a file cannot be moved, what was there before is put back: Error naming it. Files of a longer
    /// series of an earlier export ("hip_0300.png" beside a new "hip_0200.png" as the last) are removed, unless the folder is shared:
    /// they would pass for these.
    /// No input of the scene is replaced, no link to another folder followed: Error, with nothing moved.
    void commit(const Scene& scene);
    /// The same for what no scene stands behind.
    void commit(const std::set<std::filesystem::path>& inputs);

private:
    void move(const std::vector<std::filesystem::path>& files);
    std::filesystem::path folder_, place_;
    Use use_;
    MadeFolders made_;
    std::optional<FolderLock> lock_;
};

} // namespace fascicle
