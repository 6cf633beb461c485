#pragma once
// Measures the frames of recordings on a thread of its own, in order, as they come.

#include "fascicle/metrics/metric_table.hpp"

#include <condition_variable>
#include <deque>
#include <thread>

namespace fascicle::editor {

/// Values of one run, measured so far. rows[k][m][r]: frame k, muscle m, row r of metric_table().
struct MetricValues {
    ScenePtr scene; ///< of the run: names of muscles, parameters
    std::vector<std::vector<std::vector<double>>> rows;
    int frame_count() const { return static_cast<int>(rows.size()); }
};

/// The calls are for one thread, the interface's.
class MetricsWorker {
public:
    MetricsWorker();
    ~MetricsWorker();
    MetricsWorker(const MetricsWorker&) = delete;
    MetricsWorker& operator=(const MetricsWorker&) = delete;

    /// Runs whose values are kept, the present one not counted.
    static constexpr std::size_t kept_runs = 5;

    /// Once a frame: the recording to measure (may be null), and takes over what has been measured.
    void follow(const RecordingPtr& recording);
    /// Follows nothing and keeps no earlier values.
    void forget();
    /// Values of the recording being followed.
    const MetricValues& current() const { return current_; }
    /// Values of earlier runs that reached at least one frame, newest first.
    const std::deque<MetricValues>& earlier() const { return earlier_; }
    /// Whether frames of the recording wait to be measured or taken over.
    bool behind() const {
        return followed_ != nullptr && !failed_ && current_.frame_count() < followed_->frame_count();
    }
    /// Waits until every frame that the recording has now is measured, or measuring has failed, and takes them over.
    void finish();
    /// The first error of measuring since the last call, empty when there was none.
    std::string take_error();

private:
    void work();
    void take();

    MetricValues current_;
    std::deque<MetricValues> earlier_;
    RecordingPtr followed_;
    bool failed_ = false; ///< measuring the followed recording ended with an error

    std::mutex mutex_;
    std::condition_variable changed_;
    RecordingPtr wanted_;                                 ///< guarded by mutex_
    std::vector<std::vector<std::vector<double>>> fresh_; ///< guarded by mutex_
    /// Of the frames so far, the rows that the whole run decides (MetricRow::over_run), in their order: [frame][muscle][which]; empty: nothing
    /// new. Guarded by mutex_.
    std::vector<std::vector<std::vector<double>>> over_run_;
    int measured_ = 0;   ///< guarded by mutex_
    bool stale_ = false; ///< frames were measured that over_run_ does not know yet; guarded by mutex_
    std::string error_;  ///< guarded by mutex_
    bool quit_ = false;  ///< guarded by mutex_
    std::thread thread_;
};

} // namespace fascicle::editor
