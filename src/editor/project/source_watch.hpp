#pragma once
// Notices when another program changes a file that the scene came from, and offers to read it again.

#include "editor/feature.hpp"
#include "fascicle/scene/scene.hpp"

#include <filesystem>
#include <future>
#include <map>
#include <mutex>
#include <thread>

namespace fascicle::editor {

class SourceWatch : public Feature {
public:
    ~SourceWatch() override;
    /// The project's file and what it holds; an empty path: none.
    void project_is(const std::filesystem::path& path, const std::string& text);
    /// Looks at all files now, as the watching thread does once a second.
    void look();
    /// Reads the files again, in the background, as one undo step.
    void reload(EditorContext& context, std::vector<std::string> files);
    bool reloading() const { return reading_.valid(); }
    void finish();

    void update(EditorContext& context) override;
    void document_replaced(EditorContext& context) override;
    std::optional<double> redraw_after() const override;

private:
    struct Stamp {
        std::filesystem::file_time_type time{};
        std::uintmax_t size = 0;
        bool operator==(const Stamp&) const = default;
    };
    struct Reloaded {
        ScenePtr from;
        Scene scene;
        std::vector<std::string> notes;
    };
    /// Empty when the file is not there.
    static std::optional<Stamp> stamp(const std::string& path);
    void follow(const Scene& scene);
    void poll_reading(EditorContext& context);
    void start_thread();

    mutable std::mutex mutex_; ///< for what the thread looks at
    std::map<std::string, std::pair<std::string, Stamp>>
        files_;                        ///< path: hash of what was read, state when last seen
    std::vector<std::string> changed_; ///< to be offered
    std::string project_;              ///< path of the project's file, or empty
    std::string project_hash_;
    ScenePtr followed_;
    bool files_stale_ = true;
    std::vector<std::string> wanted_; ///< being read again
    std::future<Reloaded> reading_;
    std::vector<std::future<Reloaded>> given_up_; ///< of documents before; waited for without blocking
    std::jthread thread_;
};

} // namespace fascicle::editor
