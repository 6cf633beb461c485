#include "editor/run_shelf.hpp"

#include "fascicle/io/run_reader.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <ctime>
#include <future>
#include <unordered_set>

namespace fascicle::editor {

namespace fs = std::filesystem;

namespace {

std::string time_of_day() {
    const std::time_t now = std::time(nullptr);
    std::tm parts{};
    localtime_r(&now, &parts);
    char text[16];
    std::strftime(text, sizeof text, "%H:%M", &parts);
    return text;
}

} // namespace

std::size_t frame_bytes(const Recording& recording) {
    std::unordered_set<const Points*> seen;
    std::size_t bytes = 0;
    for (int k = 0; k < recording.frame_count(); ++k) {
        const FramePtr frame = recording.frame(k);
        bytes += sizeof(Frame) + frame->bone_poses.size() * sizeof(Pose);
        for (const PointsPtr& points : frame->muscle_positions)
            if (seen.insert(points.get()).second)
                bytes += points->size() * sizeof(Vec3);
    }
    return bytes;
}

struct RunShelf::Job {
    fs::path folder;
    std::atomic<bool> stop{false};
    std::atomic<double> fraction{0};
    std::future<RecordingPtr> result;
    bool done() const { return result.wait_for(std::chrono::seconds(0)) == std::future_status::ready; }
};

RunShelf::RunShelf() = default;

RunShelf::~RunShelf() {
    cancel_loading(); // the futures wait
}

const KeptRun* RunShelf::find(int id) const {
    const auto it =
        std::find_if(runs_.begin(), runs_.end(), [id](const KeptRun& run) { return run.id == id; });
    return it == runs_.end() ? nullptr : &*it;
}

const KeptRun* RunShelf::find(const RecordingPtr& recording) const {
    const auto it = std::find_if(runs_.begin(), runs_.end(),
                                 [&](const KeptRun& run) { return run.recording == recording; });
    return it == runs_.end() || recording == nullptr ? nullptr : &*it;
}

std::size_t RunShelf::bytes() const {
    std::size_t sum = 0;
    for (const KeptRun& run : runs_)
        sum += run.bytes;
    return sum;
}

void RunShelf::rename(int id, const std::string& name) {
    for (KeptRun& run : runs_)
        if (run.id == id && name.find_first_not_of(' ') != std::string::npos)
            run.name = name;
    ++version_;
}

void RunShelf::set_pinned(int id, bool pinned) {
    for (KeptRun& run : runs_)
        if (run.id == id)
            run.pinned = pinned;
    make_room();
    ++version_;
}

void RunShelf::remove(int id) {
    std::erase_if(runs_, [id](const KeptRun& run) { return run.id == id; });
    ++version_;
}

int RunShelf::keep(RecordingPtr recording, std::string name, fs::path folder, bool pinned) {
    KeptRun run;
    run.id = ++last_id_;
    run.name = name.empty() ? "Run " + std::to_string(run.id) : std::move(name);
    run.time = time_of_day();
    run.folder = std::move(folder);
    run.bytes = frame_bytes(*recording);
    run.recording = std::move(recording);
    run.pinned = pinned;
    runs_.insert(runs_.begin(), std::move(run));
    make_room();
    ++version_;
    return last_id_;
}

void RunShelf::make_room() {
    const auto over = [&] {
        const auto loose = static_cast<std::size_t>(
            std::count_if(runs_.begin(), runs_.end(), [](const KeptRun& run) { return !run.pinned; }));
        return loose > kept_runs || bytes() > limit_;
    };
    // The newest stays in any case: it is what is on the screen.
    for (std::size_t i = runs_.size(); i-- > 1 && over();) {
        const bool held = std::find(held_.begin(), held_.end(), runs_[i].id) != held_.end();
        if (!runs_[i].pinned && !held)
            runs_.erase(runs_.begin() + static_cast<std::ptrdiff_t>(i));
    }
}

/// Keeps a run that has ended or made place for another, once.
void RunShelf::offer(const RecordingPtr& recording) {
    if (recording == nullptr || recording == offered_)
        return;
    offered_ = recording;
    const int frames = recording->frame_count();
    const RunState state = recording->state();
    if (state == RunState::failed || frames < (state == RunState::finished ? 2 : usefully_long))
        return;
    if (find(recording) != nullptr)
        return;
    // The same scene computed again gives the same frames: no second entry.
    if (!runs_.empty() && runs_[0].folder.empty() &&
        runs_[0].recording->scene_ptr() == recording->scene_ptr()) {
        if (runs_[0].recording->frame_count() <= frames) {
            runs_[0].recording = recording;
            runs_[0].bytes = frame_bytes(*recording);
            ++version_;
        }
        return;
    }
    keep(recording, {}, {}, false);
}

void RunShelf::load(const fs::path& folder) {
    cancel_loading();
    problem_.clear();
    // "out/run/" has no file name of its own.
    const fs::path plain = folder.has_filename() ? folder : folder.parent_path();
    loading_name_ = plain.filename().string();
    job_ = std::make_unique<Job>();
    job_->folder = plain;
    job_->result = std::async(std::launch::async, [job = job_.get()]() -> RecordingPtr {
        JobControl control;
        control.cancel = &job->stop;
        control.report = [job](std::string_view, double fraction) { job->fraction = fraction; };
        return RunReader(job->folder).read_recording(control);
    });
}

double RunShelf::progress() const {
    return job_ == nullptr ? 0.0 : job_->fraction.load();
}

void RunShelf::cancel_loading() {
    if (job_ == nullptr)
        return;
    job_->stop = true;
    given_up_.push_back(std::move(job_));
}

void RunShelf::finish_loading() const {
    if (job_ != nullptr)
        job_->result.wait();
}

void RunShelf::poll(EditorContext& context) {
    std::erase_if(given_up_, [](const std::unique_ptr<Job>& job) { return job->done(); });
    if (job_ == nullptr || !job_->done())
        return;
    const std::unique_ptr<Job> job = std::move(job_);
    try {
        const RecordingPtr recording = job->result.get();
        loaded_ = keep(recording, loading_name_, job->folder, true);
        context.log.add(Severity::note, "Run read from " + job->folder.string() + ": " +
                                            std::to_string(recording->frame_count()) + " frames");
    } catch (const std::exception& problem) {
        problem_ = problem.what();
        context.log.add(Severity::error, problem_);
    }
}

void RunShelf::update(EditorContext& context) {
    poll(context);
    const RecordingPtr recording = context.runs.recording();
    if (recording != followed_) {
        offer(followed_);
        followed_ = recording;
    }
    if (followed_ != nullptr && followed_->state() != RunState::running)
        offer(followed_);
}

void RunShelf::document_replaced(EditorContext&) {
    std::erase_if(runs_, [](const KeptRun& run) { return !run.pinned; });
    ++version_;
    followed_ = offered_ = nullptr;
    problem_.clear();
}

std::optional<double> RunShelf::redraw_after() const {
    return job_ == nullptr && given_up_.empty() ? std::nullopt : std::optional<double>(1.0 / 25);
}

} // namespace fascicle::editor
