#pragma once
// Opens another scene in place of the present one: an embedded scene, a project, or one that is made already. Reading happens
// on a thread of its own; what is open stays until the new scene is there, and stays when it cannot be read.

#include "editor/feature.hpp"
#include "fascicle/io/load_scene.hpp"

#include <future>

namespace fascicle::editor {

/// A document that takes the place of the present one.
struct OpenedScene {
    Scene scene;
    std::filesystem::path path;     ///< the project's file; empty when it is none
    std::vector<std::string> notes; ///< for the log
};

class SceneOpener : public Feature {
public:
    SceneOpener();
    ~SceneOpener() override;
    /// A request under way is given up.
    void open(SceneRequest request);
    void open_embedded(const std::string& name);
    void open_project(const std::filesystem::path& path);
    /// At the next frame.
    void open_scene(OpenedScene scene);

    bool reading() const { return job_ != nullptr; }
    /// What is being read, for the status line.
    const std::string& what() const { return what_; }
    double progress() const;
    void cancel();
    /// Waits for the reader; for pictures and tests.
    void finish();

    void update(EditorContext& context) override;
    std::optional<double> redraw_after() const override;
    /// The new document, once; the editor takes it at the start of a frame.
    std::optional<OpenedScene> take();

private:
    struct Job;
    std::unique_ptr<Job> job_;
    std::vector<std::unique_ptr<Job>> given_up_; ///< told to stop, waited for without blocking
    std::optional<OpenedScene> ready_;
    std::string what_;
};

} // namespace fascicle::editor
