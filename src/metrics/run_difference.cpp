#include "fascicle/metrics/run_difference.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/metrics/fibre_measure.hpp"
#include "fascicle/metrics/muscle_measure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace fascicle {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::string counts(const TriMesh& mesh) {
    return std::to_string(mesh.vertex_count()) + " vertices and " + std::to_string(mesh.triangle_count()) +
           " triangles";
}

/// Why two muscles of one name cannot be compared; empty when they can.
std::string mesh_problem(const Muscle& a, const Muscle& b) {
    if (a.mesh == b.mesh)
        return {};
    if (a.mesh->vertex_count() == b.mesh->vertex_count() &&
        a.mesh->triangle_count() == b.mesh->triangle_count())
        return {};
    return a.name + " has other meshes: " + counts(*a.mesh) + " in A, " + counts(*b.mesh) + " in B";
}

/// The muscle of the other run: by name, and where one was renamed by its very mesh; -1 when there is none.
int partner_of(const Muscle& muscle, const Scene& own, const Scene& other) {
    if (const int same = other.muscle_index(muscle.name); same >= 0)
        return same;
    for (std::size_t m = 0; m < other.muscles.size(); ++m)
        if (other.muscles[m].mesh == muscle.mesh && own.muscle_index(other.muscles[m].name) < 0)
            return static_cast<int>(m);
    return -1;
}

} // namespace

RunMatch match_runs(const Scene& a, const Scene& b) {
    RunMatch match;
    if (a.unit != b.unit) {
        match.reason =
            std::string("lengths are in ") + to_text(a.unit) + " in A and in " + to_text(b.unit) + " in B";
        return match;
    }
    for (std::size_t i = 0; i < a.muscles.size(); ++i) {
        const Muscle& muscle = a.muscles[i];
        const int other = partner_of(muscle, a, b);
        if (other < 0) {
            match.left_out.push_back(muscle.name + " is only in A");
            continue;
        }
        const std::string problem = mesh_problem(muscle, b.muscles[static_cast<std::size_t>(other)]);
        if (problem.empty())
            match.muscles.push_back({muscle.name, static_cast<int>(i), other});
        else
            match.left_out.push_back(problem);
    }
    for (const Muscle& muscle : b.muscles)
        if (partner_of(muscle, b, a) < 0)
            match.left_out.push_back(muscle.name + " is only in B");
    if (match.muscles.empty())
        match.reason = match.left_out.empty() ? "the runs have no muscles" : match.left_out.front();
    return match;
}

std::vector<FramePair> common_frames(const Recording& a, const Recording& b, int begins) {
    std::vector<FramePair> pairs;
    const int na = a.frame_count(), nb = b.frame_count();
    for (int i = 0, j = 0; i < na && j < nb;) {
        const int p = a.frame(i)->index, q = b.frame(j)->index;
        if (p == q && p >= begins)
            pairs.push_back({p, i, j});
        i += p <= q ? 1 : 0;
        j += q <= p ? 1 : 0;
    }
    return pairs;
}

FramePtr frame_not_after(const Recording& recording, int index) {
    int low = 0, high = std::min(recording.frame_count(), index + 1); // the frame sought is before `high`
    while (low < high) {
        const int middle = (low + high) / 2;
        if (recording.frame(middle)->index <= index)
            low = middle + 1;
        else
            high = middle;
    }
    return low == 0 ? nullptr : recording.frame(low - 1);
}

std::vector<double> vertex_distances_mm(const Points& a, const Points& b, double millimetres_per_unit) {
    FASCICLE_ASSERT(a.size() == b.size());
    std::vector<double> distances;
    distances.reserve(a.size());
    for (std::size_t i = 0; i < a.size(); ++i)
        distances.push_back(millimetres_per_unit * (b[i] - a[i]).norm());
    return distances;
}

PointDistance point_distance(const Points& a, const Points& b, double millimetres_per_unit) {
    FASCICLE_ASSERT(a.size() == b.size());
    PointDistance result;
    double sum = 0, largest = -1;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double square = (b[i] - a[i]).squaredNorm();
        sum += square;
        if (square > largest) {
            largest = square;
            result.vertex = static_cast<int>(i);
        }
    }
    if (a.empty())
        return result;
    result.rms_mm = millimetres_per_unit * std::sqrt(sum / static_cast<double>(a.size()));
    result.max_mm = millimetres_per_unit * std::sqrt(std::max(0.0, largest));
    if (!std::isfinite(sum))
        result.rms_mm = result.max_mm = nan;
    return result;
}

FrameDifference frame_difference(const Frame& a, const Frame& b, const RunMatch& match,
                                 double millimetres_per_unit) {
    FrameDifference result{a.index, {}};
    for (const MatchedMuscle& muscle : match.muscles)
        result.muscles.push_back(point_distance(*a.muscle_positions[static_cast<std::size_t>(muscle.a)],
                                                *b.muscle_positions[static_cast<std::size_t>(muscle.b)],
                                                millimetres_per_unit));
    return result;
}

std::vector<FrameDifference> run_difference(const Recording& a, const Recording& b, const RunMatch& match,
                                            const JobControl& control, int begins, int most) {
    std::vector<FrameDifference> result;
    const double unit = millimetres_per_unit(a.scene().unit);
    const std::vector<FramePair> pairs = common_frames(a, b, begins);
    const std::size_t count = std::min(pairs.size(), static_cast<std::size_t>(std::max(0, most)));
    for (std::size_t i = 0; i < count; ++i) {
        control.checkpoint("compare frames", static_cast<double>(i) / static_cast<double>(count));
        result.push_back(frame_difference(*a.frame(pairs[i].a), *b.frame(pairs[i].b), match, unit));
    }
    return result;
}

std::vector<DifferenceSummary> summarise(const RunMatch& match, const std::vector<FrameDifference>& frames) {
    std::vector<DifferenceSummary> result(match.muscles.size());
    for (std::size_t m = 0; m < result.size(); ++m) {
        DifferenceSummary& all = result[m];
        double squares = 0;
        for (const FrameDifference& frame : frames) {
            const PointDistance& one = frame.muscles[m];
            squares += one.rms_mm * one.rms_mm;
            if (all.max_index < 0 || one.max_mm > all.max_mm) {
                all.max_mm = one.max_mm;
                all.max_index = frame.index;
                all.max_vertex = one.vertex;
            }
        }
        if (!frames.empty())
            all.rms_mm = std::sqrt(squares / static_cast<double>(frames.size()));
    }
    return result;
}

std::vector<ParamDifference> parameter_differences(const ParamSet& a, const ParamSet& b) {
    std::vector<ParamDifference> result;
    for (const ParamRow& row : a.table().rows())
        if (a.get(row.key) != b.get(row.key))
            result.push_back({&row, a.text(row.key), b.text(row.key)});
    return result;
}

MetricRows measure_run(const Recording& recording, int threads, const JobControl& control) {
    MetricRows rows;
    const int count = recording.frame_count();
    if (count == 0)
        return rows;
    MetricsEngine engine(recording, threads);
    for (int k = 0; k < count; ++k) {
        control.checkpoint("measure frames", double(k) / double(count));
        rows.push_back(engine.measure(*recording.frame(k)));
    }
    const std::vector<MetricRow>& table = metric_table();
    for (std::size_t m = 0; m < recording.scene().muscles.size(); ++m) {
        const FibreMeasure* fibres = engine.muscle(static_cast<int>(m)).fibres();
        if (fibres == nullptr)
            continue;
        for (int k = 0; k < std::min(count, fibres->series().frame_count()); ++k)
            for (std::size_t r = 0; r < table.size(); ++r)
                if (table[r].over_run)
                    rows[static_cast<std::size_t>(k)][m][r] = table[r].over_run(fibres->series(), k);
    }
    return rows;
}

bool comparable_metric(const MetricRow& row) {
    constexpr std::array<std::string_view, 5> of_the_solver{"contacts", "unresolved", "non_finite",
                                                            "solve_ms", "unconverged"};
    return std::find(of_the_solver.begin(), of_the_solver.end(), row.key) == of_the_solver.end();
}

double metric_difference(const MetricRows& a, const MetricRows& b, const FramePair& frames,
                         const MatchedMuscle& muscle, int row) {
    const auto value = [row](const MetricRows& rows, int frame, int index) {
        const auto k = static_cast<std::size_t>(frame), m = static_cast<std::size_t>(index);
        return row >= 0 && k < rows.size() && m < rows[k].size() ? rows[k][m][static_cast<std::size_t>(row)]
                                                                 : nan;
    };
    return value(b, frames.b, muscle.b) - value(a, frames.a, muscle.a);
}

} // namespace fascicle
