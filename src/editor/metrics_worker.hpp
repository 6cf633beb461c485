#pragma once
// Measures the frames of recordings on a thread of its own, in order, as they come.

#include "editor/metric_values.hpp"

#include <atomic>
#include <condition_variable>
#include <deque>
#include <thread>

namespace fascicle::editor {

/// The calls are for one thread, the interface's.
class MetricsWorker {
public:
    MetricsWorker();
    ~MetricsWorker();
    MetricsWorker(const MetricsWorker&) = delete;
    MetricsWorker& operator=(const MetricsWorker&) = delete;

    /// Runs whose values are kept, the present one not counted. Pinned ones are never given up: when they alone are as many,
    /// the last run is kept beside them.
    static constexpr std::size_t kept_runs = 5;

    /// Once a frame: the recording to measure (may be null), and takes over what has been measured.
    void follow(const RecordingPtr& recording);
    /// Follows nothing and keeps no earlier values, pinned ones neither.
    void forget();
    /// Values of the recording being followed.
    const MetricValues& current() const { return current_; }
    /// Values of earlier runs that reached at least one frame, newest first.
    const std::deque<MetricValues>& earlier() const { return earlier_; }
    /// Of the present or an earlier run; null when it is not kept.
    const MetricValues* find(std::uint64_t id) const;
    void set_pinned(std::uint64_t id, bool pinned);
    /// Gives up an earlier run.
    void remove(std::uint64_t id);
    /// Differs after every change of what current() and earlier() return: a key for caches.
    std::uint64_t version() const { return version_; }
    /// Whether frames of the recording wait to be measured or taken over.
    bool behind() const {
        return followed_ != nullptr && !failed_ &&
               (current_.frame_count() < followed_->frame_count() ||
                (unsettled_ && followed_->state() != RunState::running));
    }
    /// Waits until every frame that the recording has now is measured, or measuring has failed, and takes them over.
    void finish();
    /// The first error of measuring since the last call, empty when there was none.
    std::string take_error();
    /// How often the thread has woken up so far: an idle one does not.
    std::uint64_t wake_ups() const { return wake_ups_; }

private:
    /// One frame, as measured.
    struct Measured {
        std::vector<std::vector<double>> row;
        std::vector<std::size_t> fibre_counts;       ///< per muscle
        std::vector<std::vector<double>> lengths_mm; ///< per muscle
        double angle_rad = 0;
        std::map<std::string, double> stage_seconds;
    };
    /// What the whole run decides (MetricRow::over_run), of the frames so far.
    struct OverRun {
        std::vector<std::vector<std::vector<double>>> rows; ///< [frame][muscle][which]
        std::vector<std::vector<double>> moment_arms_mm;    ///< per muscle, frame-major
    };

    void work();
    void take();
    void add(Measured frame);
    void drop_surplus();
    static Measured measured(MetricsEngine& engine, const Frame& frame, std::size_t muscles);
    static OverRun over_run(const MetricsEngine& engine, std::size_t muscles, int frames);

    MetricValues current_;
    std::deque<MetricValues> earlier_;
    RecordingPtr followed_;
    bool failed_ = false;    ///< measuring the followed recording ended with an error
    bool unsettled_ = false; ///< what the whole run decides is not that of the last frame yet
    std::uint64_t version_ = 1;
    int runs_ = 0; ///< counted for their names

    std::mutex mutex_;
    std::condition_variable changed_;
    RecordingPtr wanted_;         ///< guarded by mutex_
    std::vector<Measured> fresh_; ///< guarded by mutex_
    OverRun over_run_;            ///< empty: nothing new; guarded by mutex_
    int measured_ = 0;            ///< guarded by mutex_
    bool stale_ = false; ///< frames were measured that over_run_ does not know yet; guarded by mutex_
    std::string error_;  ///< guarded by mutex_
    bool quit_ = false;  ///< guarded by mutex_
    std::atomic<std::uint64_t> wake_ups_{0};
    std::thread thread_;
};

} // namespace fascicle::editor
