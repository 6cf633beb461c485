// fascicle reproduce [--data DIR] --out DIR: every figure and table of the paper, and the rivals beside it.

#include "reproduce/reproduce.hpp"
#include "app/cli/command.hpp"
#include "app/cli/options.hpp"
#include "app/cli/progress.hpp"
#include "app/cli/run_scene.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/base/interrupt.hpp"
#include "fascicle/base/parallel.hpp"
#include "fascicle/base/suggest.hpp"
#include "fascicle/base/text.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/staged_files.hpp"
#include "fascicle/solver/soft_body_solver.hpp"
#include "reproduce/data_files.hpp"
#include "reproduce/page.hpp"
#include "reproduce/results_json.hpp"

#include <algorithm>
#include <ctime>
#include <iostream>
#include <set>

namespace fascicle::app {

namespace {

const int most_threads = 256;

struct ReproduceCommand {
    reproduce::ReproduceOptions work;
    std::string data, out;
    int threads = 0;
    bool quiet = false;
};

/// Local time, to the minute.
std::string now_text() {
    const std::time_t now = std::time(nullptr);
    std::tm local{};
    localtime_r(&now, &local);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%d %H:%M", &local);
    return text;
}

/// `--name A,B`: any of `known`, may be given again.
void add_names(CLI::App& app, const std::string& name, std::vector<std::string>& target,
               const std::vector<std::string>& known, const std::string& meaning) {
    add_reader(app, name, "A,B", meaning, true, [name, known, &target](const std::string& text) {
        for (const std::string& word : split(text, ',')) {
            if (std::find(known.begin(), known.end(), word) == known.end()) {
                std::string list;
                for (const std::string& one : known)
                    list += (list.empty() ? "" : ", ") + one;
                throw_error(name, "got '" + word + "'" + did_you_mean(word, known), "some of " + list,
                            ErrorKind::usage);
            }
            target.push_back(word);
        }
    });
}

std::set<std::string> names_in(const std::filesystem::path& folder) {
    std::set<std::string> names;
    for (const std::filesystem::directory_entry& entry : std::filesystem::directory_iterator(folder))
        if (entry.is_regular_file())
            names.insert(entry.path().filename().string());
    return names;
}

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words)
        text += (text.empty() ? "" : ", ") + word;
    return text;
}

void print(const reproduce::Results& results, const std::string& out) {
    std::size_t counts[4] = {0, 0, 0, 0};
    for (const reproduce::ExperimentResult& result : results.experiments) {
        if (!result.missing.empty())
            std::cout << "left out: " << one_line(result.experiment->key + ": " + result.missing) << '\n';
        for (const reproduce::MethodRun& run : result.runs)
            if (!run.done())
                std::cout << "failed: "
                          << one_line(result.experiment->key + ", " + run.method + ": " + run.failure)
                          << '\n';
        for (const reproduce::Finding& finding : result.findings)
            ++counts[static_cast<std::size_t>(finding.verdict)];
    }
    std::cout << counts[0] << " kept, " << counts[1] << " better, " << counts[2] << " worse, " << counts[3]
              << " shown without a verdict\nwritten to " << one_line(out) << "/report.html\n";
}

/// Of a run or a variant; empty when there is none. Parts whose data are not there are left out, and no failure.
std::string first_failure(const reproduce::Results& results) {
    for (const reproduce::ExperimentResult& result : results.experiments)
        for (const reproduce::MethodRun& run : result.runs)
            if (!run.done())
                return result.experiment->key + ", " + run.method + ": " + run.failure;
    for (const reproduce::SensitivityVariant& variant : results.sensitivity.variants)
        if (!variant.failure.empty())
            return results.sensitivity.experiment + ", " + variant.key + ": " + variant.failure;
    if (!results.speed.failures.empty())
        return "speed, " + results.speed.failures.front();
    return {};
}

int run(ReproduceCommand& command) {
    if (command.out.empty())
        throw_error("reproduce", "no output folder", "--out DIR", ErrorKind::usage);
    reproduce::ReproduceOptions& options = command.work;
    std::error_code error;
    if (!command.data.empty() && !std::filesystem::is_directory(command.data, error))
        throw_error("--data", "'" + command.data + "' is no folder", "the folder that holds the public data",
                    ErrorKind::usage);
    options.data = command.data.empty() ? reproduce::default_data_folder().value_or(std::filesystem::path())
                                        : std::filesystem::path(command.data);
    options.out = command.out;
    options.threads = command.threads > 0 ? command.threads : std::min(hardware_threads(), most_threads);
    const std::atomic<bool>& interrupted = watch_interrupts(); // before there is anything to tidy up
    StagedFiles staged(command.out);                           // locks the folder, too
    ProgressDisplay progress = ProgressDisplay::for_user(command.quiet);
    JobControl control;
    control.cancel = &interrupted;
    control.report = [&progress](std::string_view stage, double fraction) {
        progress.update({std::string(stage), fraction, 0, 0}, steady_seconds());
    };
    reproduce::Results results;
    try {
        results = reproduce::reproduce(options, control);
    } catch (const Cancelled&) {
        progress.finish();
        throw_error({}, "cancelled, no report was written; what is finished is kept in " + command.out +
                            "/work, and the same command goes on there");
    }
    progress.finish();
    write_file(staged.place() / "report.html", reproduce::report_page(results, now_text()));
    write_file(staged.place() / "results.json", reproduce::results_json(results));
    write_file(staged.place() / "timings.json", reproduce::timings_json(results));
    reproduce::write_tables(results, staged.place());
    const std::set<std::string> written = names_in(staged.place());
    const bool after_a_report =
        std::filesystem::is_regular_file(std::filesystem::path(command.out) / "results.json", error);
    staged.commit(results.inputs);
    // A table of an earlier report that this one has no rows for would pass for one of this.
    if (after_a_report)
        for (const std::string& name : names_in(command.out))
            if (reproduce::is_report_file(name) && !written.contains(name))
                std::filesystem::remove(std::filesystem::path(command.out) / name, error);
    if (!command.quiet)
        print(results, command.out);
    if (const std::string failure = first_failure(results); !failure.empty())
        throw_error({}, "not every run of the report could be made: " + failure);
    return 0;
}

} // namespace

std::function<int()> add_reproduce(CLI::App& app) {
    const auto command = std::make_shared<ReproduceCommand>();
    std::vector<std::string> methods;
    for (const SolverMethod& method : solver_methods())
        methods.push_back(method.name);
    add_text(
        app, "--data", command->data, "DIR",
        "Folder of the public data, files in sub-folders too (default: $FASCICLE_DATA, else ../shared/data; "
        "embedded scenes stand in for what is not there)");
    add_text(app, "--out", command->out, "DIR", "Folder for report.html, the tables, and the runs in work/");
    add_names(app, "--only", command->work.only, reproduce::part_keys(),
              "Parts of the report, of " + joined(reproduce::part_keys()));
    add_names(app, "--methods", command->work.methods, methods, "Methods, of " + joined(methods));
    add_whole(app, "--threads", command->threads, 1, most_threads, "N",
              "Threads (default: all); never changes a result");
    app.add_flag("--short", command->work.is_short,
                 "Few frames, coarse lattices: shows that everything works, no figures to keep");
    app.add_flag("--quiet", command->quiet, "No progress and no closing lines");
    return [command] { return run(*command); };
}

} // namespace fascicle::app
