#include "reproduce/arm_shares.hpp"

#include "reproduce/published.hpp"
#include "reproduce/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fascicle::reproduce {

namespace {

/// Beginnings of the names in LHDL_hip_r.osim and gait2392.
struct LineNames {
    const char* muscle;
    const char* begins;
};
const LineNames line_names[] = {{"gluteus_maximus", "glut_max"},
                                {"gluteus_medius", "glut_med"},
                                {"iliacus", "iliacus"},
                                {"adductor_brevis", "add_brev"}};

std::vector<double> column(const LineNumbers& lines, const WayOut& poses, std::size_t f) {
    std::vector<double> arms;
    for (const std::size_t k : poses.places)
        arms.push_back(lines.arm(k, f));
    return arms;
}

} // namespace

WayOut way_out(const RunData& run) {
    WayOut result;
    if (run.angle_deg.empty())
        return result;
    std::size_t last = 0;
    for (std::size_t k = 0; k < run.angle_deg.size(); ++k)
        if (std::abs(run.angle_deg[k] - run.angle_deg[0]) >
            std::abs(run.angle_deg[last] - run.angle_deg[0]) + 1e-9)
            last = k;
    for (std::size_t k = 0; last > 0 && k <= last; ++k) {
        result.flexion_deg.push_back(std::abs(run.angle_deg[k] - run.angle_deg[0]));
        result.places.push_back(k);
    }
    return result;
}

WayOut arm_poses(const Experiment& experiment, const RunData& run) {
    if (!is_sweep(experiment.motion))
        return way_out(run);
    WayOut result;
    const auto begin = run.angle_deg.begin();
    const auto most = std::max_element(begin, run.angle_deg.end());
    const auto least = std::min_element(most, run.angle_deg.end());
    // The frame of the turn itself has the arms of the way there (excursion_arms).
    for (auto at = least; at > most; --at) {
        result.flexion_deg.push_back(*at + sweep_turn(experiment.motion).rest_deg);
        result.places.push_back(static_cast<std::size_t>(at - begin));
    }
    return result;
}

std::vector<Span3> arm_spans(const LineNumbers& lines, const WayOut& poses) {
    std::vector<Span3> spans;
    for (const std::size_t k : poses.places) {
        std::vector<double> arms;
        for (std::size_t f = 0; f < lines.count(); ++f)
            arms.push_back(lines.arm(k, f));
        spans.push_back(span_of(arms));
    }
    return spans;
}

std::vector<double> mean_arms(const LineNumbers& lines, const WayOut& poses) {
    std::vector<double> means;
    for (const Span3& span : arm_spans(lines, poses))
        means.push_back(span.mean);
    return means;
}

std::vector<std::size_t> lines_of(const std::string& muscle, const LineNumbers& lines) {
    std::vector<std::size_t> columns;
    for (const LineNames& names : line_names)
        if (muscle == names.muscle)
            for (std::size_t f = 0; f < lines.count(); ++f)
                if (lines.names[f].starts_with(names.begins))
                    columns.push_back(f);
    return columns;
}

void measure_arms(ExperimentResult& result) {
    const Experiment& e = *result.experiment;
    // Bounds of the real muscle say nothing about a stand-in.
    const std::vector<BandPoint> band =
        result.real && !is_sweep(e.motion) ? arm_band(e.muscle) : std::vector<BandPoint>();
    /// means: over the fibres, in each pose; all: of every fibre.
    const auto table = [&](const std::vector<double>& means, const std::vector<double>& all) {
        std::vector<TableShare> shares;
        for (const PublishedArm& row : published_arms())
            if (result.real && row.motion == e.motion && e.muscle == row.muscle)
                shares.push_back({row.model,
                                  {row.least, row.mean, row.greatest},
                                  percent_between(means, row.least, row.greatest),
                                  percent_between(all, row.least, row.greatest)});
        return shares;
    };
    bool with_lines = false;
    for (const MethodRun& row : result.runs) {
        if (!row.done())
            continue;
        const WayOut poses = arm_poses(e, row.run);
        if (poses.places.empty())
            continue;
        if (row.run.fibres.count() > 0) {
            const std::vector<double> means = mean_arms(row.run.fibres, poses);
            std::vector<double> angles, arms;
            for (std::size_t f = 0; f < row.run.fibres.count(); ++f) {
                const std::vector<double> one = column(row.run.fibres, poses, f);
                angles.insert(angles.end(), poses.flexion_deg.begin(), poses.flexion_deg.end());
                arms.insert(arms.end(), one.begin(), one.end());
            }
            result.arms.push_back({row.method, percent_inside(poses.flexion_deg, means, band),
                                   percent_inside(angles, arms, band), span_of(means), span_of(arms),
                                   table(means, arms)});
        }
        // Lines follow the bones alone: the same for every method.
        if (!with_lines)
            for (const std::size_t f : lines_of(e.muscle, row.run.lines)) {
                const std::vector<double> arms = column(row.run.lines, poses, f);
                result.arms.push_back({row.run.lines.names[f] + " (line)",
                                       percent_inside(poses.flexion_deg, arms, band),
                                       std::numeric_limits<double>::quiet_NaN(), span_of(arms), span_of(arms),
                                       table(arms, arms)});
                with_lines = true;
            }
    }
}

} // namespace fascicle::reproduce
