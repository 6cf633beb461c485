#pragma once
// Copies of a project that the editor keeps by itself, in the user's folder: autosave/<session>/0001.fascicle, ... with a
// small picture beside each. A session holds a lock that ends with its process, however that ends; so what is left of a
// session without a lock is what a crash left.

#include "fascicle/io/png.hpp"
#include "fascicle/io/project_file.hpp"

#include <optional>

namespace fascicle {

/// What one session kept.
struct AutosaveSession {
    std::filesystem::path folder;
    std::string name;              ///< of the scene
    std::filesystem::path project; ///< the user's file; empty: never saved
    std::filesystem::path file;    ///< newest copy
    std::filesystem::path picture; ///< beside it; empty: none
    std::int64_t time = 0;         ///< of the newest copy, seconds since 1970
    int copies = 0;
};

/// Sessions that ended without cleaning up, the newest first. What cannot be read is passed over.
std::vector<AutosaveSession> crashed_sessions(const std::filesystem::path& user_folder);
/// Its copies are of no use any more.
void remove_autosaves(const AutosaveSession& session);

/// What is kept in one go.
struct Autosave {
    ScenePtr scene;
    std::filesystem::path project; ///< the user's file, or empty
    ProjectSaving saving;
    std::optional<PngImage> picture;
};

/// The session of this process. Its folder appears with the first copy.
class AutosaveFolder {
public:
    static constexpr int copies_kept = 5;
    explicit AutosaveFolder(std::filesystem::path user_folder) : user_folder_(std::move(user_folder)) {}
    /// Leaves the copies: only clear() removes them.
    ~AutosaveFolder();
    AutosaveFolder(const AutosaveFolder&) = delete;
    AutosaveFolder& operator=(const AutosaveFolder&) = delete;

    /// Error when the folder cannot be written.
    void write(const Autosave& copy);
    /// Removes copies, lock and folder: nothing is left to recover.
    void clear();
    const std::filesystem::path& folder() const { return folder_; } ///< empty before the first copy

private:
    void open();
    std::filesystem::path user_folder_, folder_;
    int lock_ = -1; ///< of the file "lock", held as long as the process lives
    int number_ = 0;
};

} // namespace fascicle
