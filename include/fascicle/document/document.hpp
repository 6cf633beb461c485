#pragma once
// The scene being edited, its file and its undo history. Results of runs are no part of it.

#include "fascicle/document/history.hpp"
#include "fascicle/scene/scene.hpp"

#include <cstdint>
#include <filesystem>

namespace fascicle {

/// Read by anybody, written only by the functions of document/actions/. A change is made on the scratch scene
/// (edit()) and becomes one undo step by commit(); a slider drag edits many times and commits once.
class Document {
public:
    /// path: the project file the scene came from, empty when there is none.
    explicit Document(Scene scene, std::filesystem::path path = {}, HistoryLimits limits = {});

    /// The scratch: the head with changes that are not committed yet.
    const Scene& scene() const { return scratch_; }
    /// The last committed scene. Immutable; the same pointer until the next commit, undo or redo.
    ScenePtr head() const { return history_.head(); }
    bool has_uncommitted_edits() const { return edited_; }
    const History<Scene>& history() const { return history_; }
    /// Differs after every change of scene(): a key for caches.
    std::uint64_t version() const { return version_; }

    /// Uncommitted edits count as the step that is undone. False when there is nothing to do.
    bool undo();
    bool redo();
    bool jump(std::size_t step);

    const std::filesystem::path& path() const { return path_; }
    /// Whether the head is another scene than the one that was opened or saved last.
    bool dirty() const { return edited_ || history_.head() != saved_; }
    void mark_saved(std::filesystem::path path);
    /// `saved`: what was written, which need not be the head any more.
    void mark_saved(std::filesystem::path path, ScenePtr saved);
    /// What is here is in no file, e.g. after a recovery.
    void mark_unsaved() { saved_ = nullptr; }

    // For actions only.

    Scene& edit();
    /// False, and no step, when nothing was edited since the last commit.
    bool commit(std::string name);
    /// Back to the head.
    void discard_edits();

private:
    void follow_head();

    History<Scene> history_;
    Scene scratch_;
    ScenePtr saved_;
    std::filesystem::path path_;
    bool edited_ = false;
    std::uint64_t version_ = 1;
};

/// Bytes of meshes, outlines and fibres that `scene` holds and `previous` does not.
std::size_t unshared_bytes(const Scene& scene, const Scene& previous);

} // namespace fascicle
