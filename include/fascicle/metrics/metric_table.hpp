#pragma once
// Metrics as rows: name, unit and a function of one frame of one muscle. CSV, plots and the summary find them
// here.

#include "fascicle/scene/recording.hpp"

#include <functional>

namespace fascicle {

class FibreSeries;   // what the fibres of a muscle do over a run (metrics/fibre_series.hpp)
class MuscleMeasure; // the quantities of one frame of one muscle (metrics/muscle_measure.hpp)

struct MetricRow {
    std::string key;   ///< column name in metrics.csv, unit as suffix
    std::string label; ///< shown to people
    std::string unit;
    std::string meaning;
    std::function<double(const MuscleMeasure&)> value;
    bool of_fibres = false; ///< NaN for a muscle without fibres
    /// Of a number that the frames around a frame decide: its value at frame k of the series, right once the run is over; `value`
    /// is NaN then. Null for all others.
    std::function<double(const FibreSeries&, int)> over_run = nullptr;
};

/// The first rows are those of the contract after frame, muscle and angle_deg, in its order.
const std::vector<MetricRow>& metric_table();

/// Index of a row by key, -1 when there is none.
int metric_index(std::string_view key);

/// Values of all rows for frames of a recording. Keeps what may be reused between frames (rest quantities,
/// bounds for the penetration test): any order of frames is right, ascending order is fast. Not thread-safe.
class MetricsEngine {
public:
    /// A recording with at least frame 0 (rest), and with its attachments set.
    explicit MetricsEngine(const Recording& recording, int threads = 1);
    /// rest: frame 0 of the recording. The attachments are those of the scene's muscles; for a muscle that
    /// has none of its own (they are found when a run is prepared) the drift of attachments is NaN.
    MetricsEngine(ScenePtr scene, const Frame& rest, int threads = 1);
    ~MetricsEngine();
    MetricsEngine(const MetricsEngine&) = delete;
    MetricsEngine& operator=(const MetricsEngine&) = delete;

    /// One list of values per muscle, in the order of metric_table().
    std::vector<std::vector<double>> measure(const Frame& frame);

    /// The quantities of a muscle in the frame last measured (rest before the first).
    const MuscleMeasure& muscle(int index) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace fascicle
