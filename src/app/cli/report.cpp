// fascicle report SOURCE|RUN --out FILE.html: a run as one page with pictures, plots and numbers.

#include "app/cli/command.hpp"
#include "app/cli/options.hpp"
#include "app/cli/run_film.hpp"
#include "app/cli/run_scene.hpp"
#include "app/cli/source_options.hpp"
#include "fascicle/base/interrupt.hpp"
#include "fascicle/io/run_reader.hpp"

#include <iostream>

namespace fascicle::app {

namespace {

struct ReportOptions {
    std::string run;
    SourceOptions source;
    SolveOptions solve;
    std::string out;
    bool quiet = false;
};

RecordingPtr recording_of(const ReportOptions& options, ProgressDisplay& progress) {
    if (!options.run.empty()) {
        JobControl control;
        control.cancel = &watch_interrupts();
        return RunReader(options.run).read_recording(control);
    }
    LoadedScene loaded = load(options.source, options.solve);
    RecordingPtr recording = run_scene(std::make_shared<const Scene>(std::move(loaded.scene)),
                                       {thread_count(options.solve), loaded.notes}, progress,
                                       [](const Recording&, const FramePtr&) {});
    if (recording->state() == RunState::cancelled)
        throw_error(options.out, "cancelled, no report was written");
    return recording;
}

int report(const ReportOptions& options) {
    if (options.out.empty())
        throw_error("report", "no page to write", "--out FILE.html", ErrorKind::usage);
    if (!options.run.empty() && options.source.given)
        throw_error("report", "got the run '" + options.run + "' and a source", "one of the two",
                    ErrorKind::usage);
    check_output_file(options.out, options.run, options.source, options.solve);
    ProgressDisplay progress = ProgressDisplay::for_user(options.quiet);
    const RecordingPtr recording = recording_of(options, progress);
    write_report(options.out, recording, thread_count(options.solve), progress);
    if (!options.quiet)
        std::cout << options.out << "\n";
    return 0;
}

} // namespace

std::function<int()> add_report(CLI::App& app) {
    const auto options = std::make_shared<ReportOptions>();
    app.add_option("RUN", options->run, "Folder of a run made with --export vtp; instead of SOURCE");
    add_source_options(app, options->source);
    add_text(app, "--out", options->out, "FILE.html", "The page");
    add_solve_options(app, options->solve);
    app.add_flag("--quiet", options->quiet, "No progress");
    return [options] { return report(*options); };
}

} // namespace fascicle::app
