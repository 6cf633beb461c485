#pragma once
// The project's file: what the document does not hold of it, writing it in the background, and the list of recent ones.

#include "editor/feature.hpp"
#include "editor/project/project_flow.hpp"
#include "fascicle/io/png.hpp"
#include "fascicle/io/project_file.hpp"

#include <future>

namespace fascicle::editor {

struct OpenedScene;

class ProjectKeeper : public Feature {
public:
    ProjectKeeper();
    ~ProjectKeeper() override;
    /// The document comes from there.
    void opened(EditorContext& context, const OpenedScene& scene);
    /// Text of the file that the document came from: fields that this version does not know are kept from it.
    const std::string& text() const { return text_; }
    void set_text(std::string text, bool carry_meshes);
    bool carry_meshes() const { return carry_meshes_; }
    /// Of the user's own document, also while a lesson is in front.
    ProjectSaving user_saving() const { return aside_ ? *aside_ : ProjectSaving{text_, carry_meshes_}; }
    /// What a lesson had set aside is the document again.
    void returned(EditorContext& context);

    /// Writes the last committed scene on a thread. When that fails, the save dialog says why and asks for another name; the
    /// document stays as it was, unsaved. A save under way is waited for first.
    void save(EditorContext& context, std::filesystem::path path, bool carry_meshes, Then then);
    bool saving() const { return job_ != nullptr; }
    /// Waits for the writer; its outcome comes with the next update().
    void finish();

    void update(EditorContext& context) override;
    void document_replaced(EditorContext& context) override;
    std::optional<double> redraw_after() const override;

private:
    struct Job;
    void done(EditorContext& context, Job& job);
    std::string text_;
    bool carry_meshes_ = false;
    std::optional<ProjectSaving> aside_; ///< while a lesson is in front
    std::unique_ptr<Job> job_;
    std::uint64_t generation_ = 0;      ///< of the document
    std::future<void> listing_;         ///< writes the list of recent projects
    std::optional<double> picture_due_; ///< for a project that was opened and has none
};

} // namespace fascicle::editor
