#include "editor/metrics_worker.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace fascicle::editor {

MetricsWorker::MetricsWorker() : thread_([this] { work(); }) {}

MetricsWorker::~MetricsWorker() {
    {
        const std::lock_guard lock(mutex_);
        quit_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void MetricsWorker::follow(const RecordingPtr& recording) {
    if (recording != followed_) {
        take();
        if (current_.frame_count() > 1) {
            earlier_.push_front(std::move(current_));
            if (earlier_.size() > kept_runs)
                earlier_.pop_back();
        }
        current_ = {};
        followed_ = recording;
        failed_ = false;
        if (recording != nullptr)
            current_.scene = recording->scene_ptr();
        const std::lock_guard lock(mutex_);
        wanted_ = recording;
        fresh_.clear();
        error_.clear();
        measured_ = 0;
        changed_.notify_all();
    }
    take();
}

void MetricsWorker::take() {
    const std::lock_guard lock(mutex_);
    for (auto& row : fresh_)
        current_.rows.push_back(std::move(row));
    fresh_.clear();
    failed_ = failed_ || !error_.empty();
}

void MetricsWorker::finish() {
    if (followed_ == nullptr || failed_)
        return;
    const int wanted = followed_->frame_count();
    {
        std::unique_lock lock(mutex_);
        changed_.notify_all();
        changed_.wait(lock, [&] { return measured_ >= wanted || !error_.empty(); });
    }
    take();
}

std::string MetricsWorker::take_error() {
    const std::lock_guard lock(mutex_);
    return std::exchange(error_, {});
}

void MetricsWorker::work() {
    using namespace std::chrono_literals;
    RecordingPtr recording;
    std::unique_ptr<MetricsEngine> engine;
    int next = 0;
    std::unique_lock lock(mutex_);
    while (!quit_) {
        if (wanted_ != recording) {
            recording = wanted_;
            engine.reset();
            next = 0;
        }
        const bool waiting = recording == nullptr || recording->frame_count() <= next;
        if (waiting) {
            changed_.wait_for(lock, recording == nullptr ? 1s : 30ms); // frames come without a signal
            continue;
        }
        lock.unlock();
        std::vector<std::vector<double>> row;
        std::string error;
        try {
            if (engine == nullptr)
                engine = std::make_unique<MetricsEngine>(*recording);
            row = engine->measure(*recording->frame(next));
        } catch (const std::exception& problem) {
            error = problem.what();
        }
        lock.lock();
        if (wanted_ != recording)
            continue; // another run is wanted by now
        if (!error.empty()) {
            error_ = error;
            wanted_ = recording = nullptr;
        } else {
            fresh_.push_back(std::move(row));
            measured_ = ++next;
        }
        changed_.notify_all();
    }
}

} // namespace fascicle::editor
