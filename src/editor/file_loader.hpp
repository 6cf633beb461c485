#pragma once
// Reads files that are no meshes in the background, and puts what they hold into the scene: attachment outlines, surface
// fibres, fibre templates, line muscles, motions. One after the other; a file that cannot be read leaves the scene as it was.

#include "editor/feature.hpp"
#include "fascicle/base/job_control.hpp"

#include <deque>
#include <functional>
#include <memory>

namespace fascicle::editor {

class FileLoader : public Feature {
public:
    /// What is to be done with a file that was read, on the thread of the interface.
    using Apply = std::function<void(EditorContext&)>;
    using Work = std::function<Apply(const JobControl&)>;

    FileLoader();
    ~FileLoader() override;

    /// Sends each file where it belongs.
    void drop(std::vector<std::filesystem::path> files);
    // To the selected muscle; when none is, to the one that the file's name begins with, else to the only one. An error in the log when
    // it cannot be told.
    void load_outlines(EditorContext& context, const std::filesystem::path& path);
    void load_surface_fibres(EditorContext& context, const std::filesystem::path& path);
    void load_fibre_template(EditorContext& context, const std::filesystem::path& path);
    /// A model's muscles as lines.
    void load_lines(EditorContext& context, const std::filesystem::path& path);
    /// Keyed poses from CSV.
    void load_motion(EditorContext& context, const std::filesystem::path& path);
    /// A .mot or .sto table, for the motion panel.
    void load_table(EditorContext& context, const std::filesystem::path& path);

    /// Work on a thread; errors go to the log. what: the file's name, shown meanwhile.
    void start(std::string what, Work work);
    bool reading() const { return !jobs_.empty(); }
    const std::string& what() const;
    double progress() const;
    /// Gives up everything that is being read or waits.
    void cancel();
    /// Waits for the reader; for tests.
    void finish();

    void update(EditorContext& context) override;
    void document_replaced(EditorContext& context) override;
    std::optional<double> redraw_after() const override;

private:
    struct Job;
    void begin_next();
    std::deque<std::unique_ptr<Job>> jobs_; ///< the first is under way
    std::vector<std::unique_ptr<Job>> given_up_;
};

/// Index of the muscle that a file is for, as above; -1: it cannot be told.
int muscle_for_file(const EditorContext& context, const std::filesystem::path& path);

} // namespace fascicle::editor
