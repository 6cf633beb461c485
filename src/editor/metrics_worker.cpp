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
constexpr double none = std::numeric_limits<double>::quiet_NaN();

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

std::uint64_t next_id() {
    static std::atomic<std::uint64_t> last{0};
    return ++last;
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
            drop_surplus();
        }
        current_ = {};
        followed_ = recording;
        failed_ = unsettled_ = false;
        ++version_;
        if (recording != nullptr) {
            current_.scene = recording->scene_ptr();
            current_.id = next_id();
            current_.name = "Run " + std::to_string(++runs_);
        }
        const std::lock_guard lock(mutex_);
        wanted_ = recording;
        fresh_.clear();
        over_run_ = {};
        error_.clear();
        measured_ = 0;
        stale_ = false;
        changed_.notify_all();
    }
    if (recording != nullptr && current_.scene != recording->scene_ptr()) {
        current_.scene = recording->scene_ptr(); // it was renamed
        ++version_;
    }
    take();
    if (behind())
        changed_.notify_all(); // whoever waits for a run that had ended
}

void MetricsWorker::forget() {
    follow(nullptr);
    current_ = {};
    earlier_.clear();
    runs_ = 0;
    ++version_;
}

const MetricValues* MetricsWorker::find(std::uint64_t id) const {
    if (id != 0 && current_.id == id)
        return &current_;
    for (const MetricValues& values : earlier_)
        if (values.id == id)
            return &values;
    return nullptr;
}

void MetricsWorker::set_pinned(std::uint64_t id, bool pinned) {
    if (current_.id == id)
        current_.pinned = pinned;
    for (MetricValues& values : earlier_)
        if (values.id == id)
            values.pinned = pinned;
    drop_surplus();
    ++version_;
}

void MetricsWorker::remove(std::uint64_t id) {
    std::erase_if(earlier_, [&](const MetricValues& values) { return values.id == id; });
    ++version_;
}

/// The oldest goes that nobody holds; the newest stays in any case.
void MetricsWorker::drop_surplus() {
    for (std::size_t i = earlier_.size(); earlier_.size() > kept_runs && i-- > 1;)
        if (!earlier_[i].pinned)
            earlier_.erase(earlier_.begin() + static_cast<std::ptrdiff_t>(i));
}

void MetricsWorker::add(Measured frame) {
    MetricValues& v = current_;
    const std::size_t k = v.rows.size();
    v.rows.push_back(std::move(frame.row));
    v.angles_rad.push_back(frame.angle_rad);
    v.fibres.resize(frame.fibre_counts.size());
    for (std::size_t m = 0; m < v.fibres.size(); ++m) {
        v.fibres[m].count = frame.fibre_counts[m];
        v.fibres[m].lengths_mm.insert(v.fibres[m].lengths_mm.end(), frame.lengths_mm[m].begin(),
                                      frame.lengths_mm[m].end());
    }
    for (const auto& [stage, seconds] : frame.stage_seconds)
        v.stages_ms[stage].resize(k, 0.0); // a stage that begins late took no time before
    for (auto& [stage, values] : v.stages_ms) {
        const auto found = frame.stage_seconds.find(stage);
        values.push_back(found == frame.stage_seconds.end() ? 0.0 : 1000 * found->second);
    }
}

void MetricsWorker::take() {
    const std::lock_guard lock(mutex_);
    if (!fresh_.empty() || !over_run_.rows.empty())
        ++version_;
    for (Measured& frame : fresh_)
        add(std::move(frame));
    fresh_.clear();
    for (std::size_t k = 0; k < std::min(over_run_.rows.size(), current_.rows.size()); ++k)
        for (std::size_t m = 0; m < over_run_.rows[k].size(); ++m)
            for (std::size_t i = 0; i < over_run_rows().size(); ++i)
                current_.rows[k][m][over_run_rows()[i]] = over_run_.rows[k][m][i];
    for (std::size_t m = 0; m < std::min(over_run_.moment_arms_mm.size(), current_.fibres.size()); ++m)
        current_.fibres[m].moment_arms_mm = std::move(over_run_.moment_arms_mm[m]);
    over_run_ = {};
    unsettled_ = stale_;
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
    failed_ = failed_ || !error_.empty();
    return std::exchange(error_, {});
}

MetricsWorker::Measured MetricsWorker::measured(MetricsEngine& engine, const Frame& frame,
                                                std::size_t muscles) {
    Measured result;
    result.row = engine.measure(frame);
    result.angle_rad = frame.angle_rad;
    result.stage_seconds = frame.report.stage_seconds;
    result.fibre_counts.resize(muscles);
    result.lengths_mm.resize(muscles);
    for (std::size_t m = 0; m < muscles; ++m) {
        const FibreMeasure* fibres = engine.muscle(static_cast<int>(m)).fibres();
        if (fibres == nullptr || fibres->series().frame_count() == 0)
            continue;
        const FibreSeries& series = fibres->series();
        result.fibre_counts[m] = static_cast<std::size_t>(series.fibre_count());
        result.lengths_mm[m] = series.values(FibreQuantity::length, series.frame_count() - 1);
    }
    return result;
}

MetricsWorker::OverRun MetricsWorker::over_run(const MetricsEngine& engine, std::size_t muscles, int frames) {
    OverRun result;
    bool any = false;
    for (std::size_t m = 0; m < muscles; ++m)
        any = any || engine.muscle(static_cast<int>(m)).fibres() != nullptr;
    if (!any)
        return result;
    result.moment_arms_mm.resize(muscles);
    for (int k = 0; k < frames; ++k) {
        auto& frame = result.rows.emplace_back(muscles);
        for (std::size_t m = 0; m < muscles; ++m) {
            const FibreMeasure* fibres = engine.muscle(static_cast<int>(m)).fibres();
            const bool there = fibres != nullptr && k < fibres->series().frame_count();
            for (const std::size_t r : over_run_rows())
                frame[m].push_back(there ? metric_table()[r].over_run(fibres->series(), k) : none);
            if (!there)
                continue;
            const std::vector<double> arms = fibres->series().values(FibreQuantity::moment_arm, k);
            result.moment_arms_mm[m].insert(result.moment_arms_mm[m].end(), arms.begin(), arms.end());
        }
    }
    return result;
}

void MetricsWorker::work() {
    using namespace std::chrono_literals;
    RecordingPtr recording;
    std::unique_ptr<MetricsEngine> engine;
    int next = 0;
    Clock::time_point refreshed{};
    std::unique_lock lock(mutex_);
    while (!quit_) {
        ++wake_ups_;
        if (wanted_ != recording) {
            recording = wanted_;
            engine.reset();
            next = 0;
            stale_ = false;
        }
        // In this order: a run that has ended has all its frames.
        const bool running = recording != nullptr && recording->state() == RunState::running;
        const bool waiting = recording == nullptr || recording->frame_count() <= next;
        // While a run goes on now and then, at its end at once: finish() waits for it.
        if (waiting && stale_ && engine != nullptr &&
            (!running || Clock::now() - refreshed > over_run_interval)) {
            lock.unlock();
            OverRun values = over_run(*engine, recording->scene().muscles.size(), next);
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
            if (running)
                changed_.wait_for(lock, 30ms); // frames come without a signal
            else
                changed_.wait(lock); // follow() and finish() call
            continue;
        }
        lock.unlock();
        Measured frame;
        std::string error;
        try {
            if (engine == nullptr)
                engine = std::make_unique<MetricsEngine>(*recording);
            frame = measured(*engine, *recording->frame(next), recording->scene().muscles.size());
        } catch (const std::exception& problem) {
            error = problem.what();
        }
        lock.lock();
        if (wanted_ != recording)
            continue; // another run is wanted by now
        if (!error.empty()) {
            error_ = error;
            wanted_ = recording = nullptr;
            engine.reset();
            stale_ = false;
        } else {
            fresh_.push_back(std::move(frame));
            measured_ = ++next;
            stale_ = true;
        }
        changed_.notify_all();
    }
}

} // namespace fascicle::editor
