#include "reproduce/arm_shares.hpp"

#include "reproduce/published.hpp"

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

std::vector<double> mean_arms(const LineNumbers& lines, const WayOut& poses) {
    std::vector<double> means;
    for (const std::size_t k : poses.places) {
        std::vector<double> arms;
        for (std::size_t f = 0; f < lines.count(); ++f)
            arms.push_back(lines.arm(k, f));
        means.push_back(span_of(arms).mean);
    }
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
    // Bounds of the real muscle say nothing about a stand-in.
    const std::vector<BandPoint> band =
        result.real ? arm_band(result.experiment->muscle) : std::vector<BandPoint>();
    bool with_lines = false;
    for (const MethodRun& row : result.runs) {
        if (!row.done())
            continue;
        const WayOut poses = way_out(row.run);
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
                                   percent_inside(angles, arms, band), span_of(means)});
        }
        // Lines follow the bones alone: the same for every method.
        if (!with_lines)
            for (const std::size_t f : lines_of(result.experiment->muscle, row.run.lines)) {
                const std::vector<double> arms = column(row.run.lines, poses, f);
                result.arms.push_back({row.run.lines.names[f] + " (line)",
                                       percent_inside(poses.flexion_deg, arms, band),
                                       std::numeric_limits<double>::quiet_NaN(), span_of(arms)});
                with_lines = true;
            }
    }
}

} // namespace fascicle::reproduce
