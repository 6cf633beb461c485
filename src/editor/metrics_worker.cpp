#include "editor/metrics_worker.hpp"

#include "fascicle/metrics/muscle_measure.hpp"

#include <algorithm>
#include <chrono>
#include <limits>
#include <utility>

namespace fascicle::editor {

namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds over_run_interval{400};

const std::vector<std::size_t>& over_run_rows() {
    static const std::vector<std::size_t> rows = [] {
        std::vector<std::size_t> found;
        for (std::size_t r = 0; r < metric_table().size(); ++r)
            if (metric_table()[r].over_run)
                found.push_back(r);
        return found;
    }();
    return rows;
}

/// [frame][muscle][which of over_run_rows()]; empty when no muscle has fibres.
std::vector<std::vector<std::vector<double>>> over_run_values(const MetricsEngine& engine,
                                                              std::size_t muscles, int frames) {
    std::vector<std::vector<std::vector<double>>> values;
    bool any = false;
    for (std::size_t m = 0; m < muscles; ++m)
        any = any || engine.muscle(static_cast<int>(m)).fibres() != nullptr;
    for (int k = 0; k < frames && any; ++k) {
        auto& frame = values.emplace_back(muscles);
        for (std::size_t m = 0; m < muscles; ++m) {
            const FibreMeasure* fibres = engine.muscle(static_cast<int>(m)).fibres();
            for (const std::size_t r : over_run_rows())
                frame[m].push_back(fibres != nullptr && k < fibres->series().frame_count()
                                       ? metric_table()[r].over_run(fibres->series(), k)
                                       : std::numeric_limits<double>::quiet_NaN());
        }
    }
    return values;
}

} // namespace

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
        over_run_.clear();
        error_.clear();
        measured_ = 0;
        changed_.notify_all();
    }
    take();
}

void MetricsWorker::forget() {
    follow(nullptr);
    current_ = {};
    earlier_.clear();
}

void MetricsWorker::take() {
    const std::lock_guard lock(mutex_);
    for (auto& row : fresh_)
        current_.rows.push_back(std::move(row));
    fresh_.clear();
    for (std::size_t k = 0; k < std::min(over_run_.size(), current_.rows.size()); ++k)
        for (std::size_t m = 0; m < over_run_[k].size(); ++m)
            for (std::size_t i = 0; i < over_run_rows().size(); ++i)
                current_.rows[k][m][over_run_rows()[i]] = over_run_[k][m][i];
    over_run_.clear();
    failed_ = failed_ || !error_.empty();
}

void MetricsWorker::finish() {
    if (followed_ == nullptr || failed_)
        return;
    const int wanted = followed_->frame_count();
    {
        std::unique_lock lock(mutex_);
        changed_.notify_all();
        changed_.wait(lock, [&] {
            return (measured_ >= wanted && (!stale_ || followed_->state() == RunState::running)) ||
                   !error_.empty();
        });
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
    Clock::time_point refreshed{};
    std::unique_lock lock(mutex_);
    while (!quit_) {
        if (wanted_ != recording) {
            recording = wanted_;
            engine.reset();
            next = 0;
            stale_ = false;
        }
        const bool waiting = recording == nullptr || recording->frame_count() <= next;
        // While a run goes on now and then, at its end at once: finish() waits for it.
        if (waiting && stale_ && engine != nullptr &&
            (recording->state() != RunState::running || Clock::now() - refreshed > over_run_interval)) {
            lock.unlock();
            auto values = over_run_values(*engine, recording->scene().muscles.size(), next);
            refreshed = Clock::now();
            lock.lock();
            if (wanted_ != recording)
                continue;
            over_run_ = std::move(values);
            stale_ = false;
            changed_.notify_all();
            continue;
        }
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
            stale_ = true;
        }
        changed_.notify_all();
    }
}

} // namespace fascicle::editor
