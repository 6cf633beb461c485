// fascicle bench: how fast everything is here, as a table and as JSON.

#include "bench/bench.hpp"
#include "app/cli/command.hpp"
#include "app/cli/options.hpp"
#include "app/cli/progress.hpp"
#include "app/cli/run_scene.hpp"
#include "bench/bench_cases.hpp"
#include "bench/variants.hpp"
#include "fascicle/base/interrupt.hpp"
#include "fascicle/base/suggest.hpp"
#include "fascicle/io/files.hpp"

#include <algorithm>
#include <iostream>

namespace fascicle::app {

namespace {

const int most_threads = 256;
const int least_runs = 5;

struct BenchCommand {
    bench::BenchOptions bench;
    std::string data, json = "bench.json", threads = "1,2";
    int runs = 0;
    bool quiet = false;
};

/// `--name A,B`: any of `known`, may be given again.
void add_names(CLI::App& app, const std::string& name, std::vector<std::string>& target,
               const std::vector<std::string>& known, const std::string& meaning) {
    std::string type;
    for (const std::string& word : known)
        type += (type.empty() ? "" : ",") + word;
    add_reader(app, name, type, meaning, true, [name, known, type, &target](const std::string& text) {
        for (const std::string& word : split(text, ',')) {
            if (std::find(known.begin(), known.end(), word) == known.end())
                throw_error(name, "got '" + word + "'" + did_you_mean(word, known), "some of " + type,
                            ErrorKind::usage);
            target.push_back(word);
        }
    });
}

bench::BenchOptions complete(const BenchCommand& command) {
    bench::BenchOptions options = command.bench;
    std::error_code error;
    if (!command.data.empty() && !std::filesystem::is_directory(command.data, error))
        throw_error("--data", "'" + command.data + "' is no folder", "the folder that holds lhdl/",
                    ErrorKind::usage);
    options.data = command.data.empty() ? bench::default_data_folder() : std::filesystem::path(command.data);
    options.threads.clear();
    for (const std::string& part : split(command.threads, ','))
        options.threads.push_back(read_whole("--threads", part, 1, most_threads));
    std::sort(options.threads.begin(), options.threads.end());
    options.threads.erase(std::unique(options.threads.begin(), options.threads.end()), options.threads.end());
    if (options.is_short && options.frames == 0)
        options.frames = 2;
    options.runs = command.runs > 0 ? command.runs : options.is_short ? 2 : least_runs;
    return options;
}

int run(const BenchCommand& command) {
    const bench::BenchOptions options = complete(command);
    check_output_name(command.json); // before minutes are spent
    ProgressDisplay progress = ProgressDisplay::for_user(command.quiet);
    JobControl control;
    control.cancel = &watch_interrupts();
    control.report = [&progress](std::string_view stage, double fraction) {
        progress.update({std::string(stage), fraction, 0, 0}, steady_seconds());
    };
    bench::Report report;
    try {
        report = bench::run_bench(options, control);
    } catch (const Cancelled&) {
        progress.finish();
        throw_error("bench", "cancelled; nothing was written");
    }
    progress.finish();
    std::cout << bench::report_table(report) << std::flush;
    write_file(command.json, bench::report_json(report));
    std::cout << "written to " << command.json << '\n';
    return 0;
}

} // namespace

std::function<int()> add_bench(CLI::App& app) {
    const auto command = std::make_shared<BenchCommand>();
    bench::BenchOptions& options = command->bench;
    add_text(app, "--data", command->data, "DIR",
             "Folder of the real data (default: $FASCICLE_DATA, else ../shared/data)");
    add_names(app, "--case", options.cases, bench::case_names(), "Which scenes (default: all)");
    add_names(app, "--method", options.methods, bench::variant_names(), "Which solvers (default: all)");
    add_names(app, "--part", options.parts, bench::part_names(), "What to measure (default: all)");
    add_text(app, "--threads", command->threads, "LIST", "Numbers of threads (default: 1,2)");
    add_whole(app, "--runs", command->runs, 1, 1000, "N", "Runs of each figure (default: 5)");
    add_whole(app, "--frames", options.frames, 1, 1000000, "N",
              "Frames of a run at most (default: the whole motion)");
    app.add_flag("--short", options.is_short, "Least effort: shows that the bench works, no figures to keep");
    add_text(app, "--json", command->json, "FILE", "Where the JSON goes (default: bench.json)");
    app.add_flag("--quiet", command->quiet, "No progress");
    return [command] { return run(*command); };
}

} // namespace fascicle::app
