#include "reproduce/run_data.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/base/param_table.hpp"
#include "fascicle/io/csv.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/metrics/metric_table.hpp"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace fascicle::reproduce {

namespace fs = std::filesystem;

namespace {

const double none = std::numeric_limits<double>::quiet_NaN();

/// Tables hold "nan" where a number is not known.
double number_of(const CsvReader& csv, int column) {
    const std::string& text = csv.cell(column);
    return text.empty() || text == "nan" || text == "inf" || text == "-inf" ? none : csv.number(column);
}

int need(const CsvReader& csv, const fs::path& path, const std::string& name) {
    const int column = csv.column(name);
    if (column < 0)
        throw_error(path.string(), "has no column '" + name + "'", "a table of a run");
    return column;
}

void read_metrics(RunData& run) {
    const fs::path path = run.folder / "metrics.csv";
    const std::string bytes = read_file(path);
    CsvReader csv(bytes, path.string());
    const int frame = need(csv, path, "frame"), angle = need(csv, path, "angle_deg");
    std::vector<std::pair<int, std::vector<double>*>> columns;
    for (const MetricRow& row : metric_table())
        if (row.key != "solve_ms")
            if (const int column = csv.column(row.key); column >= 0)
                columns.emplace_back(column, &run.metrics[row.key]);
    while (csv.next_row()) {
        run.frame.push_back(paper_frames * csv.number(frame) / std::max(1, run.last_frame));
        run.angle_deg.push_back(csv.number(angle));
        for (const auto& [column, values] : columns)
            values->push_back(number_of(csv, column));
    }
}

/// `name_column`: of fibres.csv "fibre", of lines.csv "muscle".
LineNumbers read_lines(const fs::path& path, const char* name_column) {
    LineNumbers lines;
    std::error_code error;
    if (!fs::exists(path, error))
        return lines;
    const std::string bytes = read_file(path);
    CsvReader csv(bytes, path.string());
    const int frame = need(csv, path, "frame"), name = need(csv, path, name_column),
              length = need(csv, path, "length_mm"), arm = need(csv, path, "moment_arm_mm");
    std::string first;
    for (bool begun = false; csv.next_row(); begun = true) {
        if (!begun)
            first = csv.cell(frame);
        if (csv.cell(frame) == first)
            lines.names.push_back(csv.cell(name));
        lines.length_mm.push_back(number_of(csv, length));
        lines.moment_arm_mm.push_back(number_of(csv, arm));
    }
    if (!lines.names.empty() && lines.length_mm.size() % lines.names.size() != 0)
        throw_error(path.string(), "the last frame is not whole", "as many rows as in the others");
    return lines;
}

void read_summary(RunData& run) {
    const fs::path path = run.folder / "summary.json";
    try {
        const auto json = nlohmann::json::parse(read_file(path));
        run.method = json.at("method");
        run.state_hash = json.at("state_hash");
        run.last_frame = json.at("frames");
        run.vertices = json.at("muscles").at(0).at("vertices");
        run.triangles = json.at("muscles").at(0).at("triangles");
        run.notes = json.value("notes", std::vector<std::string>());
        run.times = {json.at("prepare_seconds"), json.at("solve_seconds"), json.at("fps_median"),
                     json.at("threads")};
    } catch (const nlohmann::json::exception& problem) {
        throw_error(path.string(), problem.what(), "the summary of a run");
    }
}

} // namespace

std::vector<double> RunData::metric(const std::string& key) const {
    const auto it = metrics.find(key);
    return it != metrics.end() ? it->second : std::vector<double>(frame.size(), none);
}

std::size_t RunData::index_at(double paper_frame) const {
    std::size_t best = 0;
    for (std::size_t k = 0; k < frame.size(); ++k)
        if (std::abs(frame[k] - paper_frame) < std::abs(frame[best] - paper_frame))
            best = k;
    return best;
}

RunData read_run(const fs::path& folder) {
    RunData run;
    run.folder = folder;
    read_summary(run);
    read_metrics(run);
    run.fibres = read_lines(folder / "fibres.csv", "fibre");
    run.lines = read_lines(folder / "lines.csv", "muscle");
    return run;
}

} // namespace fascicle::reproduce
