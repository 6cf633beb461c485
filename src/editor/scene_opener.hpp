#pragma once
// Opens another scene in place of the present one: an embedded scene, a project, or one that is made already. Reading happens
// on a thread of its own; what is open stays until the new scene is there, and stays when it cannot be read.

#include "editor/feature.hpp"
#include "fascicle/io/project_file.hpp"

#include <functional>
#include <future>

namespace fascicle::editor {

/// A document that takes the place of the present one.
struct OpenedScene {
    Scene scene;
    std::filesystem::path path;     ///< the project's file; empty when it is none
    std::vector<std::string> notes; ///< for the log
    /// When not null, this, with its undo history, instead of scene and path.
    std::shared_ptr<Document> document{};
    std::string project_text{};             ///< of the file, for the fields that this version does not know
    bool carry_meshes = false;              ///< the project was saved with its meshes inside
    bool unsaved = false;                   ///< it is in no file as it is here
    std::filesystem::path recovered_from{}; ///< folder of the session whose copy it is
    bool start_page = false;                ///< the start page stays in front
    /// What was open when it was asked for: a later change of that asks again. Null: nothing to compare with.
    ScenePtr asked_head{};
};

/// A project whose files are not all where it says; asked about by the locate dialog.
struct MissingFiles {
    std::filesystem::path project;
    std::vector<MissingFile> files;
    LocatedFiles located;   ///< found already
    bool recovered = false; ///< `project` is a copy of `user_path`, see recover()
    std::filesystem::path user_path{};
};

class SceneOpener : public Feature {
public:
    SceneOpener();
    ~SceneOpener() override;
    /// A request under way is given up.
    void open(SceneRequest request);
    void open_embedded(const std::string& name);
    /// Files in `located` are read where they are now. When others are missing, take_missing() tells instead.
    void open_project(const std::filesystem::path& path, LocatedFiles located = {});
    /// A copy that was kept by itself, of the user's project `path` (or of none): opened as unsaved.
    void recover(const std::filesystem::path& copy, const std::filesystem::path& path,
                 LocatedFiles located = {});
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
    /// Once.
    std::optional<MissingFiles> take_missing();
    /// Why the last thing could not be opened; empty when it could.
    const std::string& problem() const { return problem_; }

private:
    struct Job;
    struct Result;
    /// Opens it, or tells what is missing.
    void read_project(MissingFiles request);
    void start(std::string what, std::function<Result(const JobControl&)> read);
    std::unique_ptr<Job> job_;
    std::vector<std::unique_ptr<Job>> given_up_; ///< told to stop, waited for without blocking
    ScenePtr asked_head_;                        ///< of the document when the job began
    std::optional<OpenedScene> ready_;
    std::optional<MissingFiles> missing_;
    std::string what_, problem_;
};

} // namespace fascicle::editor
