#include "bench/report.hpp"

#include <algorithm>

namespace fascicle::bench {

namespace {

const FrameRow* classic_of(const Report& report, const std::string& case_name) {
    const auto it = std::find_if(report.frames.begin(), report.frames.end(), [&](const FrameRow& row) {
        return row.method == "classic" && row.case_name == case_name;
    });
    return it == report.frames.end() ? nullptr : &*it;
}

const ScalingRow* scaling_of(const Report& report, int level, int threads) {
    const auto it = std::find_if(report.scaling.begin(), report.scaling.end(), [&](const ScalingRow& row) {
        return row.level == level && row.threads == threads;
    });
    return it == report.scaling.end() ? nullptr : &*it;
}

} // namespace

void add_ratios(Report& report) {
    for (FrameRow& row : report.frames) {
        const auto info = std::find_if(report.cases.begin(), report.cases.end(),
                                       [&](const CaseInfo& c) { return c.name == row.case_name; });
        if (info != report.cases.end() && info->published)
            row.times_published = row.rate.median / published_frames_per_second;
        if (const FrameRow* classic = classic_of(report, row.case_name); classic && classic->rate.median > 0)
            row.times_classic = row.rate.median / classic->rate.median;
    }
    for (ScalingRow& row : report.scaling) {
        if (const ScalingRow* first = scaling_of(report, 1, row.threads); first && row.level >= 1)
            row.growth = row.ns.median / first->ns.median;
        if (const ScalingRow* single = scaling_of(report, row.level, 1); single && row.threads > 1)
            row.speedup = single->ns.median / row.ns.median;
    }
}

void add_spread_warning(Report& report) {
    int undecided = 0;
    for (const FrameRow& row : report.frames)
        undecided += row.undecided();
    for (const ScalingRow& row : report.scaling)
        undecided += row.ns.undecided();
    for (const PrepareRow& row : report.prepare)
        undecided += row.seconds.undecided();
    for (const LimitRow& row : report.fibres)
        undecided += row.value.undecided();
    for (const LimitRow& row : report.paint)
        undecided += row.value.undecided();
    for (const LimitRow& row : report.limits)
        undecided += row.value.undecided();
    if (undecided > 0)
        report.warnings.push_back(
            "figures undecided: " + std::to_string(undecided) +
            ", marked with ?: runs more than 20 % apart, or other programs on the processor");
}

} // namespace fascicle::bench
