#include "bench/bench.hpp"

#include <algorithm>
#include <cstdio>

namespace fascicle::bench {

namespace {

using Cells = std::vector<std::string>;

std::string fixed(double value, int decimals) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    return text;
}

/// Three digits that matter: 1234, 123, 12.3, 1.23.
std::string figure(double value) {
    return fixed(value, value >= 99.95 ? 0 : value >= 9.995 ? 1 : 2);
}

template <typename Text>
std::string or_dash(const std::optional<double>& value, const Text& text) {
    return value ? text(*value) : "-";
}

std::string times(double value) {
    return figure(value) + "x";
}

std::string range(const Spread& spread, bool undecided) {
    return figure(spread.min) + "-" + figure(spread.max) + (undecided ? " ?" : "");
}

std::string range(const Spread& spread) {
    return range(spread, spread.undecided());
}

/// Columns as wide as their widest cell; numbers to the right, the first `left` columns to the left.
std::string table(const std::vector<Cells>& rows, std::size_t left) {
    std::vector<std::size_t> widths(rows.front().size(), 0);
    for (const Cells& row : rows)
        for (std::size_t i = 0; i < row.size(); ++i)
            widths[i] = std::max(widths[i], row[i].size());
    std::string text;
    for (const Cells& row : rows) {
        std::string line;
        for (std::size_t i = 0; i < row.size(); ++i) {
            const std::string space(widths[i] - row[i].size(), ' ');
            if (i > 0)
                line += "  ";
            line += i < left ? row[i] : space;
            line += i < left ? space : row[i];
        }
        line.erase(line.find_last_not_of(' ') + 1);
        text += line + "\n";
    }
    return text;
}

std::string megabytes(std::size_t bytes) {
    return bytes == 0            ? "?"
           : bytes >= (1u << 20) ? figure(double(bytes) / (1 << 20)) + " MB"
                                 : fixed(double(bytes) / 1024, 0) + " kB";
}

std::string heading(const Machine& m) {
    return m.cpu + ", " + std::to_string(m.cores) + (m.cores == 1 ? " thread, " : " threads, ") +
           m.instructions + ", caches " + megabytes(m.l1_bytes) + " / " + megabytes(m.l2_bytes) + " / " +
           megabytes(m.l3_bytes) + "\n" + m.compiler + " " + m.build + ": " + m.flags + "\n";
}

std::string frames_table(const Report& report) {
    std::vector<Cells> rows{{"case", "method", "passes", "threads", "frames/s", "range", "published",
                             "classic", "us/pass", "bytes/triangle"}};
    for (const FrameRow& row : report.frames)
        rows.push_back({row.case_name, row.method, std::to_string(row.passes), std::to_string(row.threads),
                        figure(row.rate.median), range(row.rate, row.undecided()),
                        or_dash(row.times_published, times), or_dash(row.times_classic, times),
                        figure(row.pass_us), or_dash(row.bytes_per_triangle, figure)});
    return table(rows, 2);
}

std::string stage_lines(const Report& report) {
    std::string text;
    for (const FrameRow& row : report.frames) {
        if (row.stage_us.empty())
            continue;
        text += row.case_name + " " + row.method + " " + std::to_string(row.passes) + "/" +
                std::to_string(row.threads) + ":";
        for (const auto& [stage, us] : row.stage_us)
            text += " " + stage + " " + figure(us);
        text += "\n";
    }
    return text;
}

std::string scaling_table(const Report& report) {
    std::vector<Cells> rows{{"method", "triangles", "threads", "ns/triangle/substep", "range", "growth",
                             "speedup", "bytes/triangle"}};
    for (const ScalingRow& row : report.scaling)
        rows.push_back({row.method, std::to_string(row.triangles), std::to_string(row.threads),
                        figure(row.ns.median), range(row.ns), or_dash(row.growth, times),
                        or_dash(row.speedup, times), or_dash(row.bytes_per_triangle, figure)});
    return table(rows, 1);
}

std::string prepare_table(const Report& report) {
    std::vector<Cells> rows{{"case", "grids on disk", "threads", "seconds", "range"}};
    std::string stages = "seconds by stage\n";
    for (const PrepareRow& row : report.prepare) {
        rows.push_back({row.case_name, row.cache, std::to_string(row.threads), fixed(row.seconds.median, 3),
                        fixed(row.seconds.min, 3) + "-" + fixed(row.seconds.max, 3) +
                            (row.seconds.undecided() ? " ?" : "")});
        stages += row.case_name + " " + row.cache + "/" + std::to_string(row.threads) + ":";
        for (const auto& [stage, seconds] : row.stage_seconds)
            stages += " " + stage + " " + fixed(seconds, 3);
        stages += "\n";
    }
    return table(rows, 2) + stages;
}

std::string rows_table(const char* title, const std::vector<LimitRow>& list) {
    std::vector<Cells> rows{{title, "unit", "threads", "median", "range"}};
    for (const LimitRow& row : list)
        rows.push_back(
            {row.name, row.unit, std::to_string(row.threads), figure(row.value.median), range(row.value)});
    return table(rows, 2);
}

} // namespace

std::string report_table(const Report& report) {
    std::string text = heading(report.machine);
    text += "median of " + std::to_string(report.runs) + (report.runs == 1 ? " run" : " runs") + "\n";
    const auto section = [&text](const std::string& title, const std::string& body) {
        text += "\n";
        text += title;
        text += body;
    };
    if (!report.frames.empty()) {
        section("", frames_table(report));
        section("microseconds a pass by stage\n", stage_lines(report));
    }
    if (!report.scaling.empty())
        section(report.main_case + " subdivided\n", scaling_table(report));
    if (!report.prepare.empty())
        section("from files to solvers at rest\n", prepare_table(report));
    if (!report.fibres.empty())
        section("", rows_table("100 fibres of 15 segments", report.fibres));
    if (!report.paint.empty())
        section("", rows_table("painting", report.paint));
    if (!report.limits.empty())
        section("", rows_table("machine limit", report.limits));
    if (!report.skipped.empty() || !report.warnings.empty())
        text += "\n";
    for (const Skip& skip : report.skipped)
        text += "left out: " + skip.what + ", " + skip.reason + "\n";
    for (const std::string& warning : report.warnings)
        text += "note: " + warning + "\n";
    return text;
}

} // namespace fascicle::bench
