#include "editor/scene_opener.hpp"

#include "fascicle/base/parallel.hpp"

#include <atomic>
#include <chrono>

namespace fascicle::editor {

namespace fs = std::filesystem;

struct SceneOpener::Result {
    OpenedScene opened;
    MissingFiles missing; ///< when it names any, nothing was opened
};

struct SceneOpener::Job {
    std::atomic<bool> stop{false};
    std::atomic<double> fraction{0};
    std::future<Result> result;
    bool done() const { return result.wait_for(std::chrono::seconds(0)) == std::future_status::ready; }
};

SceneOpener::SceneOpener() = default;

SceneOpener::~SceneOpener() {
    cancel(); // the futures wait
}

void SceneOpener::start(std::string what, std::function<Result(const JobControl&)> read) {
    cancel();
    ready_.reset();
    missing_.reset();
    problem_.clear();
    asked_head_ = nullptr;
    what_ = std::move(what);
    job_ = std::make_unique<Job>();
    job_->result = std::async(std::launch::async, [job = job_.get(), read = std::move(read)] {
        JobControl control;
        control.cancel = &job->stop;
        control.report = [job](std::string_view, double fraction) { job->fraction = fraction; };
        return read(control);
    });
}

void SceneOpener::open(SceneRequest request) {
    if (!request.project.empty())
        return open_project(request.project);
    const std::string what = !request.osim.model.empty() ? request.osim.model.filename().string()
                             : request.embedded.empty()  ? "meshes"
                                                         : request.embedded;
    request.threads = std::max(1, hardware_threads() - 1);
    start(what, [request = std::move(request)](const JobControl& control) {
        LoadedScene loaded = load_scene(request, control);
        return Result{{std::move(loaded.scene), {}, std::move(loaded.notes)}, {}};
    });
}

void SceneOpener::open_embedded(const std::string& name) {
    SceneRequest request;
    request.embedded = name;
    open(std::move(request));
}

void SceneOpener::open_project(const fs::path& path, LocatedFiles located) {
    read_project({path, {}, std::move(located)});
}

void SceneOpener::recover(const fs::path& copy, const fs::path& path, LocatedFiles located) {
    read_project({copy, {}, std::move(located), true, path});
}

void SceneOpener::read_project(MissingFiles request) {
    const std::string what =
        (request.recovered && !request.user_path.empty() ? request.user_path : request.project)
            .filename()
            .string();
    start(what, [request = std::move(request)](const JobControl& control) {
        Result result;
        result.missing = request;
        result.missing.files = missing_project_files(request.project, request.located);
        if (!result.missing.files.empty())
            return result;
        const int threads = std::max(1, hardware_threads() - 1);
        Project project = read_project_file(request.project, threads, control, request.located);
        result.opened.scene = std::move(project.scene);
        result.opened.path = request.recovered ? request.user_path : request.project;
        result.opened.notes = std::move(project.notes);
        result.opened.project_text = std::move(project.text);
        result.opened.carry_meshes = project.carry_meshes;
        result.opened.unsaved = request.recovered || !request.located.empty();
        if (request.recovered)
            result.opened.recovered_from = request.project.parent_path();
        return result;
    });
}

void SceneOpener::open_scene(OpenedScene scene) {
    cancel();
    problem_.clear();
    ready_ = std::move(scene);
}

double SceneOpener::progress() const {
    return job_ == nullptr ? 0.0 : job_->fraction.load();
}

void SceneOpener::cancel() {
    if (job_ == nullptr)
        return;
    job_->stop = true;
    given_up_.push_back(std::move(job_));
}

void SceneOpener::finish() {
    if (job_ != nullptr)
        job_->result.wait();
}

void SceneOpener::update(EditorContext& context) {
    std::erase_if(given_up_, [](const std::unique_ptr<Job>& job) { return job->done(); });
    if (job_ != nullptr && asked_head_ == nullptr)
        asked_head_ = context.document.head();
    if (job_ == nullptr || !job_->done())
        return;
    const std::unique_ptr<Job> job = std::move(job_);
    try {
        Result result = job->result.get();
        if (result.missing.files.empty()) {
            ready_ = std::move(result.opened);
            ready_->asked_head = asked_head_;
        } else
            missing_ = std::move(result.missing);
    } catch (const std::exception& problem) {
        problem_ = problem.what();
        context.log.add(Severity::error, problem.what());
    }
}

std::optional<double> SceneOpener::redraw_after() const {
    if (ready_ || missing_)
        return 0.0;
    return job_ == nullptr && given_up_.empty() ? std::nullopt : std::optional<double>(1.0 / 25);
}

std::optional<OpenedScene> SceneOpener::take() {
    return std::exchange(ready_, std::nullopt);
}

std::optional<MissingFiles> SceneOpener::take_missing() {
    return std::exchange(missing_, std::nullopt);
}

} // namespace fascicle::editor
