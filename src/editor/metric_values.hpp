#pragma once
// What has been measured of one run, for plots and tables.

#include "fascicle/metrics/metric_table.hpp"

#include <cstdint>
#include <map>

namespace fascicle::editor {

/// Every fibre of one muscle, frame-major: value of fibre f at frame k is [k * count + f]. count 0: no fibres. Moment arms are
/// those of the frames so far and may be fewer than the lengths while a run goes on.
struct FibreValues {
    std::size_t count = 0;
    std::vector<double> lengths_mm, moment_arms_mm;
};

/// Values of one run, measured so far. rows[k][m][r]: frame k, muscle m, row r of metric_table().
struct MetricValues {
    std::uint64_t id = 0; ///< differs between all runs of the program; 0: none
    std::string name;     ///< "Run 3"
    bool pinned = false;  ///< kept however many runs come
    ScenePtr scene;       ///< of the run: names of muscles, parameters
    std::vector<std::vector<std::vector<double>>> rows;
    std::vector<FibreValues> fibres;                      ///< per muscle; empty before the first frame
    std::vector<double> angles_rad;                       ///< per frame
    std::map<std::string, std::vector<double>> stages_ms; ///< per stage and frame: FrameReport::stage_seconds
    int frame_count() const { return static_cast<int>(rows.size()); }
};

} // namespace fascicle::editor
