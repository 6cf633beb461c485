#include "editor/scene_opener.hpp"

#include "fascicle/base/parallel.hpp"

#include <atomic>
#include <chrono>

namespace fascicle::editor {

namespace fs = std::filesystem;

struct SceneOpener::Job {
    std::atomic<bool> stop{false};
    std::atomic<double> fraction{0};
    std::future<OpenedScene> result;
    bool done() const { return result.wait_for(std::chrono::seconds(0)) == std::future_status::ready; }
};

SceneOpener::SceneOpener() = default;

SceneOpener::~SceneOpener() {
    cancel(); // the futures wait
}

void SceneOpener::open(SceneRequest request) {
    cancel();
    ready_.reset();
    what_ = request.embedded.empty() ? request.project.filename().string() : request.embedded;
    request.threads = std::max(1, hardware_threads() - 1);
    job_ = std::make_unique<Job>();
    job_->result = std::async(std::launch::async, [job = job_.get(), request = std::move(request)] {
        JobControl control;
        control.cancel = &job->stop;
        control.report = [job](std::string_view, double fraction) { job->fraction = fraction; };
        LoadedScene loaded = load_scene(request, control);
        return OpenedScene{std::move(loaded.scene), request.project, std::move(loaded.notes)};
    });
}

void SceneOpener::open_embedded(const std::string& name) {
    SceneRequest request;
    request.embedded = name;
    open(std::move(request));
}

void SceneOpener::open_project(const fs::path& path) {
    SceneRequest request;
    request.project = path;
    open(std::move(request));
}

void SceneOpener::open_scene(OpenedScene scene) {
    cancel();
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
    if (job_ == nullptr || !job_->done())
        return;
    const std::unique_ptr<Job> job = std::move(job_);
    try {
        ready_ = job->result.get();
    } catch (const std::exception& problem) {
        context.log.add(Severity::error, problem.what());
    }
}

std::optional<double> SceneOpener::redraw_after() const {
    if (ready_)
        return 0.0;
    return job_ == nullptr && given_up_.empty() ? std::nullopt : std::optional<double>(1.0 / 25);
}

std::optional<OpenedScene> SceneOpener::take() {
    return std::exchange(ready_, std::nullopt);
}

} // namespace fascicle::editor
