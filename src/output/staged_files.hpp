#pragma once
// Several files that appear together or not at all.

#include "fascicle/scene/scene.hpp"

#include <filesystem>

namespace fascicle::output {

/// Error (usage) naming the input when `file` is a file that the scene was read from.
void check_no_input(const std::filesystem::path& file, const Scene& scene);

/// A hidden folder beside the final files; commit() moves what is in it, the destructor removes the rest.
class StagedFiles {
public:
    /// folder: where the files shall be, made when missing. Error naming it when it cannot be written to.
    explicit StagedFiles(std::filesystem::path folder);
    ~StagedFiles();
    StagedFiles(const StagedFiles&) = delete;
    StagedFiles& operator=(const StagedFiles&) = delete;

    /// Where files are to be written meanwhile, in folders of their own if need be.
    const std::filesystem::path& place() const { return place_; }
    /// Moves all files to the final folder, replacing those of the same name. Files of a longer series of an earlier export
    /// ("hip_0300.png" beside a new "hip_0200.png" as the last) are removed: they would pass for these. No input of the scene is
    /// replaced: Error, with nothing moved.
    void commit(const Scene& scene);

private:
    std::filesystem::path folder_, place_, made_; ///< made_: the highest folder that was not there before
};

} // namespace fascicle::output
