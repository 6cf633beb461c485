#include "editor/project/project_keeper.hpp"

#include "editor/dialogs/dialogs.hpp"
#include "editor/features.hpp"
#include "editor/project/thumbnail.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/project_file.hpp"
#include "fascicle/io/recent_projects.hpp"

#include <chrono>
#include <ctime>

namespace fascicle::editor {

namespace fs = std::filesystem;

struct ProjectKeeper::Job {
    fs::path path;
    ScenePtr scene;
    bool carry_meshes = false;
    Then then;
    std::uint64_t generation = 0;
    std::optional<PngImage> picture;
    std::future<std::string> text; ///< what was written
};

namespace {

RecentProject recent(const fs::path& path, const std::string& name) {
    return {path, name, static_cast<std::int64_t>(std::time(nullptr))};
}

/// The list is a convenience: that it cannot be written is nobody's concern.
void list_quietly(const fs::path& folder, const RecentProject& project,
                  const std::optional<PngImage>& picture) {
    try {
        add_recent_project(folder, project, picture);
    } catch (const std::exception&) {
    }
}

} // namespace

ProjectKeeper::ProjectKeeper() = default;
ProjectKeeper::~ProjectKeeper() = default; // the futures wait

void ProjectKeeper::set_text(std::string text, bool carry_meshes) {
    text_ = std::move(text);
    carry_meshes_ = carry_meshes;
}

void ProjectKeeper::opened(EditorContext& context, const OpenedScene& scene) {
    set_text(scene.project_text, scene.carry_meshes);
    if (context.features.lessons.set_aside() == nullptr)
        aside_.reset();
    context.features.watch.project_is(scene.path, scene.project_text);
    picture_due_.reset();
    if (scene.path.empty() || context.user_folder.empty())
        return;
    listing_ = std::async(std::launch::async, list_quietly, context.user_folder,
                          recent(scene.path, scene.scene.name), std::nullopt);
    std::error_code error;
    if (!fs::exists(recent_picture(context.user_folder, scene.path), error))
        picture_due_ = context.now + 1; // when the camera has found its place
}

void ProjectKeeper::returned(EditorContext& context) {
    if (aside_)
        set_text(aside_->previous_text, aside_->carry_meshes);
    aside_.reset();
    context.features.watch.project_is(context.document.path(), text_);
}

void ProjectKeeper::document_replaced(EditorContext& context) {
    ++generation_;
    const bool lesson = context.features.lessons.set_aside() != nullptr;
    if (lesson && !aside_)
        aside_ = ProjectSaving{text_, carry_meshes_};
    if (!lesson)
        aside_.reset();
    set_text({}, false);
    picture_due_.reset();
}

void ProjectKeeper::save(EditorContext& context, fs::path path, bool carry_meshes, Then then) {
    if (job_ != nullptr) {
        finish();
        update(context);
    }
    job_ = std::make_unique<Job>();
    job_->path = std::move(path);
    job_->scene = context.document.head();
    job_->carry_meshes = carry_meshes;
    job_->then = std::move(then);
    job_->generation = generation_;
    if (!context.user_folder.empty())
        job_->picture = take_thumbnail(context);
    job_->text = std::async(std::launch::async, [path = job_->path, scene = job_->scene,
                                                 saving = ProjectSaving{text_, carry_meshes},
                                                 folder = context.user_folder, picture = job_->picture] {
        std::string text = project_text(path, *scene, saving);
        write_document(path, text);
        list_quietly(folder, recent(path, scene->name), picture);
        return text;
    });
}

void ProjectKeeper::finish() {
    if (job_ != nullptr)
        job_->text.wait();
}

void ProjectKeeper::update(EditorContext& context) {
    if (picture_due_ && context.now >= *picture_due_) {
        picture_due_.reset();
        if (auto picture = take_thumbnail(context))
            listing_ = std::async(std::launch::async, list_quietly, context.user_folder,
                                  recent(context.document.path(), context.document.scene().name),
                                  std::move(picture));
    }
    if (job_ == nullptr || job_->text.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
        return;
    const std::unique_ptr<Job> job = std::move(job_);
    done(context, *job);
}

void ProjectKeeper::done(EditorContext& context, Job& job) {
    const bool present = job.generation == generation_; // else another document has taken its place
    try {
        const std::string text = job.text.get();
        context.log.add(Severity::note, "Saved " + job.path.string());
        if (!present)
            return;
        context.document.mark_saved(job.path, job.scene);
        carry_meshes_ = job.carry_meshes;
        context.features.watch.project_is(job.path, text);
        if (job.then)
            job.then(context);
    } catch (const std::exception& problem) {
        context.log.add(Severity::error, problem.what());
        if (present)
            context.dialogs.save.failed(job.path, problem.what(), job.carry_meshes, std::move(job.then));
    }
}

std::optional<double> ProjectKeeper::redraw_after() const {
    if (job_ != nullptr)
        return 1.0 / 25;
    return picture_due_ ? std::optional<double>(0.5) : std::nullopt;
}

} // namespace fascicle::editor
