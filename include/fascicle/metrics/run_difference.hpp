#pragma once
// Two runs of the same muscles against each other, vertex by vertex and number by number. A is the one that is compared, B
// what it is compared with; differences of numbers are B - A.

#include "fascicle/base/job_control.hpp"
#include "fascicle/metrics/metric_table.hpp"

namespace fascicle {

/// A muscle that both runs have; indices of the scenes.
struct MatchedMuscle {
    std::string name;
    int a = -1, b = -1;
};

/// Which muscles of two runs can be compared: those of the same name with the same vertices.
struct RunMatch {
    std::vector<MatchedMuscle> muscles; ///< in the order of A
    std::vector<std::string> left_out;  ///< a sentence for each muscle that cannot be compared
    std::string reason;                 ///< why nothing can be; empty when something can
    bool comparable() const { return reason.empty(); }
};
/// The same number of vertices and triangles counts as the same mesh, since runs never renumber them.
RunMatch match_runs(const Scene& a, const Scene& b);

/// Frames that both recordings have, by Frame::index, ascending; a, b: their places in the recordings. begins: the first
/// index that counts.
struct FramePair {
    int index = 0, a = 0, b = 0;
};
std::vector<FramePair> common_frames(const Recording& a, const Recording& b, int begins = 0);
/// The last frame whose index is not above `index`; null when there is none.
FramePtr frame_not_after(const Recording& recording, int index);

/// Distances between the same vertices of two surfaces, millimetres: d_i = |b_i - a_i|.
struct PointDistance {
    double rms_mm = 0; ///< sqrt(1/V sum d_i^2)
    double max_mm = 0;
    int vertex = -1; ///< with the largest distance, the first of several; -1 without vertices
};
/// a, b: the same number of points, in scene units. A distance that is not finite makes rms and max NaN.
PointDistance point_distance(const Points& a, const Points& b, double millimetres_per_unit);
/// d_i of every vertex.
std::vector<double> vertex_distances_mm(const Points& a, const Points& b, double millimetres_per_unit);

/// One frame of both runs: a value per matched muscle.
struct FrameDifference {
    int index = 0; ///< Frame::index of both
    std::vector<PointDistance> muscles;
};
FrameDifference frame_difference(const Frame& a, const Frame& b, const RunMatch& match,
                                 double millimetres_per_unit);
/// All common frames from `begins` on, at most `most` of them. Throws Cancelled.
std::vector<FrameDifference> run_difference(const Recording& a, const Recording& b, const RunMatch& match,
                                            const JobControl& control = {}, int begins = 0,
                                            int most = 1 << 30);

/// Of one muscle over the frames.
struct DifferenceSummary {
    double rms_mm = 0; ///< over all vertices of all frames: sqrt(mean of the frames' rms^2)
    double max_mm = 0;
    int max_index = -1, max_vertex = -1; ///< where the largest distance is; -1 without frames
};
/// One per matched muscle.
std::vector<DifferenceSummary> summarise(const RunMatch& match, const std::vector<FrameDifference>& frames);

/// A parameter that two sets have different values of, as text that ParamSet::set_text reads.
struct ParamDifference {
    const ParamRow* row = nullptr;
    std::string a, b;
};
std::vector<ParamDifference> parameter_differences(const ParamSet& a, const ParamSet& b);

/// rows[k][m][r]: the k-th frame of a recording, muscle m, row r of metric_table().
using MetricRows = std::vector<std::vector<std::vector<double>>>;
/// All frames that the recording has, those numbers included that the whole run decides (MetricRow::over_run).
/// Throws Cancelled.
MetricRows measure_run(const Recording& recording, int threads = 1, const JobControl& control = {});

/// Whether a row tells of shape and place: not of how hard the solver worked, which a run read from files does not know.
bool comparable_metric(const MetricRow& row);
/// B - A of one row of one muscle in a pair of frames; NaN where either has no value (or no rows yet).
double metric_difference(const MetricRows& a, const MetricRows& b, const FramePair& frames,
                         const MatchedMuscle& muscle, int row);

} // namespace fascicle
