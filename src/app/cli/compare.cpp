// fascicle compare RUN_A RUN_B --out DIR: how far two runs are apart, frame by frame.

#include "app/cli/command.hpp"
#include "app/cli/options.hpp"
#include "app/cli/progress.hpp"
#include "app/cli/run_scene.hpp"
#include "fascicle/base/interrupt.hpp"
#include "fascicle/base/parallel.hpp"
#include "fascicle/base/text.hpp"
#include "fascicle/io/csv.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/run_reader.hpp"
#include "fascicle/io/staged_files.hpp"
#include "fascicle/metrics/run_difference.hpp"

#include <cmath>
#include <iomanip>
#include <iostream>
#include <nlohmann/json.hpp>
#include <numbers>

namespace fascicle::app {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct CompareOptions {
    std::string a, b, out;
    int threads = 0;
    bool quiet = false;
};

/// All that is written.
struct Comparison {
    RecordingPtr a, b;
    RunMatch match;
    std::vector<FramePair> frames;
    std::vector<FrameDifference> distances;
    std::vector<DifferenceSummary> summary;
    std::vector<ParamDifference> parameters;
    MetricRows rows_a, rows_b;
};

/// A row of the table is written where any muscle has a value of it.
std::vector<int> written_metrics(const Comparison& compared) {
    std::vector<int> rows;
    for (std::size_t r = 0; r < metric_table().size(); ++r) {
        const MetricRow& row = metric_table()[r];
        bool any = !row.of_fibres;
        for (const FramePair& frames : compared.frames)
            for (const MatchedMuscle& muscle : compared.match.muscles)
                any = any || std::isfinite(metric_difference(compared.rows_a, compared.rows_b, frames, muscle,
                                                             static_cast<int>(r)));
        if (comparable_metric(row) && any)
            rows.push_back(static_cast<int>(r));
    }
    return rows;
}

void write_table(const fs::path& path, const Comparison& compared) {
    const std::vector<int> metrics = written_metrics(compared);
    AtomicFile file(path);
    CsvWriter csv(file.stream());
    for (const char* name : {"frame", "muscle", "angle_deg", "rms_mm", "max_mm", "max_vertex"})
        csv.text(name);
    for (const int row : metrics)
        csv.text("b_minus_a_" + metric_table()[static_cast<std::size_t>(row)].key);
    csv.end_row();
    for (std::size_t i = 0; i < compared.frames.size(); ++i) {
        const FramePair& frames = compared.frames[i];
        const double angle_deg = compared.a->frame(frames.a)->angle_rad * 180 / std::numbers::pi;
        for (std::size_t m = 0; m < compared.match.muscles.size(); ++m) {
            const MatchedMuscle& muscle = compared.match.muscles[m];
            const PointDistance& distance = compared.distances[i].muscles[m];
            csv.integer(frames.index).text(muscle.name).number(angle_deg);
            csv.number(distance.rms_mm).number(distance.max_mm).integer(distance.vertex);
            for (const int row : metrics)
                csv.number(metric_difference(compared.rows_a, compared.rows_b, frames, muscle, row));
            csv.end_row();
        }
    }
    file.commit();
}

Json run_json(const std::string& folder, const Recording& run) {
    return {{"run", folder}, {"scene", run.scene().name}, {"frames", run.last_frame()->index}};
}

/// A number where the parameter is one, else the choice's name.
Json value_json(const ParamRow& row, const std::string& text) {
    double value = 0;
    return row.kind != ParamKind::choice && parse_number(text, value) ? Json(value) : Json(text);
}

void write_summary(const fs::path& path, const CompareOptions& options, const Comparison& compared) {
    Json json;
    json["a"] = run_json(options.a, *compared.a);
    json["b"] = run_json(options.b, *compared.b);
    json["common_frames"] = compared.frames.size();
    json["parameters"] = Json::array();
    for (const ParamDifference& row : compared.parameters)
        json["parameters"].push_back({{"key", row.row->key},
                                      {"label", row.row->label},
                                      {"unit", row.row->unit},
                                      {"a", value_json(*row.row, row.a)},
                                      {"b", value_json(*row.row, row.b)}});
    json["muscles"] = Json::array();
    for (std::size_t m = 0; m < compared.match.muscles.size(); ++m) {
        const DifferenceSummary& all = compared.summary[m];
        json["muscles"].push_back({{"name", compared.match.muscles[m].name},
                                   {"rms_mm", all.rms_mm},
                                   {"max_mm", all.max_mm},
                                   {"max_frame", all.max_index},
                                   {"max_vertex", all.max_vertex}});
    }
    json["left_out"] = compared.match.left_out;
    write_file(path, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

void print(const Comparison& compared) {
    std::size_t width = std::string("muscle").size();
    for (const MatchedMuscle& muscle : compared.match.muscles)
        width = std::max(width, muscle.name.size());
    for (const std::string& text : compared.match.left_out)
        std::cout << "note: left out: " << one_line(text) << '\n';
    if (compared.parameters.empty())
        std::cout << "all parameters are the same\n";
    for (const ParamDifference& row : compared.parameters)
        std::cout << row.row->key << ": " << row.a << " in A, " << row.b << " in B\n";
    const auto padded = [&](const std::string& text) {
        return one_line(text) + std::string(width - text.size(), ' ');
    };
    std::cout << compared.frames.size() << " common frames\n"
              << padded("muscle") << "    rms mm    max mm  at frame\n"
              << std::fixed << std::setprecision(4);
    for (std::size_t m = 0; m < compared.match.muscles.size(); ++m) {
        const DifferenceSummary& all = compared.summary[m];
        std::cout << padded(compared.match.muscles[m].name) << std::setw(10) << all.rms_mm << std::setw(10)
                  << all.max_mm << std::setw(10) << all.max_index << '\n';
    }
}

int compare(const CompareOptions& options) {
    if (options.a.empty() || options.b.empty())
        throw_error("compare", "needs two runs", "RUN_A RUN_B, folders made with --export vtp",
                    ErrorKind::usage);
    if (options.out.empty())
        throw_error("compare", "no output folder", "--out DIR", ErrorKind::usage);
    ProgressDisplay progress = ProgressDisplay::for_user(options.quiet);
    JobControl control;
    control.cancel = &watch_interrupts();
    control.report = [&](std::string_view stage, double fraction) {
        progress.update({std::string(stage), fraction, 0, 0}, steady_seconds());
    };
    Comparison compared;
    // The scenes first: runs that do not belong together are refused before all frames are read.
    const RunReader a(options.a), b(options.b);
    compared.match = match_runs(*a.scene(), *b.scene());
    if (!compared.match.comparable())
        throw_error(options.b, "cannot be compared with " + options.a + ": " + compared.match.reason,
                    "two runs of the same muscles");
    compared.a = a.read_recording(control);
    compared.b = b.read_recording(control);
    compared.frames = common_frames(*compared.a, *compared.b);
    compared.distances = run_difference(*compared.a, *compared.b, compared.match, control);
    compared.summary = summarise(compared.match, compared.distances);
    compared.parameters = parameter_differences(a.scene()->parameters, b.scene()->parameters);
    const int threads = options.threads > 0 ? options.threads : hardware_threads();
    compared.rows_a = measure_run(*compared.a, threads, control);
    compared.rows_b = measure_run(*compared.b, threads, control);
    progress.finish();
    StagedFiles staged(options.out);
    write_table(staged.place() / "difference.csv", compared);
    write_summary(staged.place() / "comparison.json", options, compared);
    staged.commit(std::set<fs::path>{});
    if (!options.quiet) {
        print(compared);
        std::cout << "written to " << one_line(options.out) << '\n';
    }
    return 0;
}

} // namespace

std::function<int()> add_compare(CLI::App& app) {
    const auto options = std::make_shared<CompareOptions>();
    app.add_option("RUN_A", options->a, "Folder of a run made with --export vtp");
    app.add_option("RUN_B", options->b, "Folder of the run that it is compared with");
    add_text(app, "--out", options->out, "DIR", "Folder for difference.csv and comparison.json");
    add_whole(app, "--threads", options->threads, 1, 4096, "N",
              "Threads (default: all of the machine); never changes a result");
    app.add_flag("--quiet", options->quiet, "No progress and no closing table");
    return [options] { return compare(*options); };
}

} // namespace fascicle::app
