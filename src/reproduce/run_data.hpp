#pragma once
// The numbers of one run, read from its folder: the same whether it was made now or before.

#include "fascicle/base/types.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace fascicle::reproduce {

/// The paper's motion has this many frames; runs of slow methods have fewer, and their frame k is drawn at 300 k / last.
inline constexpr double paper_frames = 300;

/// Per frame and line (fibre or line muscle): K x F, frame-major.
struct LineNumbers {
    std::vector<std::string> names; ///< F
    std::vector<double> length_mm, moment_arm_mm;
    std::size_t count() const { return names.size(); }
    double length(std::size_t k, std::size_t f) const { return length_mm[k * names.size() + f]; }
    double arm(std::size_t k, std::size_t f) const { return moment_arm_mm[k * names.size() + f]; }
};

/// What a run took. Not a result: differs from run to run.
struct RunTimes {
    double prepare_seconds = 0, solve_seconds = 0, frames_per_second = 0; ///< frames a second in the median
    int threads = 0;
};

struct RunData {
    std::filesystem::path folder;
    std::string method, state_hash;
    int last_frame = 0;
    std::size_t vertices = 0, triangles = 0;
    std::vector<double> frame;     ///< K, in the paper's count: 300 k / last_frame
    std::vector<double> angle_deg; ///< K, as in metrics.csv
    std::map<std::string, std::vector<double>>
        metrics;               ///< by key of metric_table() (but times), K values each
    LineNumbers fibres, lines; ///< empty without
    std::vector<std::string> notes;
    RunTimes times;

    /// Values of a metric; a list of NaN when there is no such column.
    std::vector<double> metric(const std::string& key) const;
    /// Index of the frame at, or nearest to, this frame of the paper's count.
    std::size_t index_at(double paper_frame) const;
    /// The frame whose angle (or, where nothing turns, whose place in the count) is the end of the way out.
    std::size_t flexed() const { return index_at(100); }
};

/// Error naming the file when a table lacks a column or holds bad numbers.
RunData read_run(const std::filesystem::path& folder);

} // namespace fascicle::reproduce
