// fascicle simulate SOURCE [options] --out DIR: runs a scene and leaves numbers, meshes and pictures.

#include "app/cli/command.hpp"
#include "app/cli/options.hpp"
#include "app/cli/run_exports.hpp"
#include "app/cli/run_scene.hpp"
#include "app/cli/run_table.hpp"
#include "app/cli/source_options.hpp"
#include "fascicle/base/interrupt.hpp"
#include "fascicle/base/text.hpp"
#include "fascicle/io/output_folder.hpp"
#include "fascicle/io/run_writer.hpp"
#include "fascicle/metrics/metric_table.hpp"
#include "fascicle/metrics/muscle_measure.hpp"
#ifdef FASCICLE_HAS_VIEW
#include "output/run_pictures.hpp"
#endif

#include <iostream>

namespace fascicle::app {

namespace {

struct SimulateOptions {
    SourceOptions source;
    SolveOptions solve;
    std::string out;
    std::vector<std::string> exports;
    ExportOptions export_options;
    int every = 1;
    bool quiet = false;
};

/// For colouring in ParaView, one list per muscle: positive inside a bone; length over rest length.
std::vector<std::vector<NamedArray>> point_arrays(const MetricsEngine& metrics, std::size_t muscles) {
    std::vector<std::vector<NamedArray>> arrays;
    for (std::size_t m = 0; m < muscles; ++m) {
        const MuscleMeasure& muscle = metrics.muscle(static_cast<int>(m));
        arrays.push_back({{"depth", 1, muscle.depth_mm_at_vertices()},
                          {"edge_extension", 1, muscle.edge_extension_at_vertices()}});
    }
    return arrays;
}

/// Throws what a user reads who pressed Ctrl-C.
[[noreturn]] void report_cancelled(const Recording& recording, const std::string& out) {
    const int last = recording.frame_count() - 1;
    const std::string total = std::to_string(recording.scene().timeline.last_frame);
    if (last < 0)
        throw_error({}, "cancelled before frame 0 of " + total + "; " + out + " holds no frames");
    throw_error({}, "cancelled at frame " + std::to_string(last) + " of " + total + "; " + out +
                        " holds frames 0.." + std::to_string(last));
}

int simulate(const SimulateOptions& options) {
    if (options.out.empty())
        throw_error("simulate", "no output folder", "--out DIR", ErrorKind::usage);
    const Exports exports = read_exports(options.exports);
    LoadedScene loaded = load(options.source, options.solve);
    const int threads = thread_count(options.solve);
    if (std::find(exports.kinds.begin(), exports.kinds.end(), output::find_export_kind("osim")) !=
            exports.kinds.end() &&
        loaded.scene.parameters.get_choice("fibres.method") == "none")
        throw_error("--export osim", "fibres.method is none: there would be nothing to write",
                    "--set fibres.method=kukacka, chmd or streamlines", ErrorKind::usage);
    const auto scene = std::make_shared<const Scene>(std::move(loaded.scene));

    without_inputs(options.out, *scene, input_files(options.source, options.solve));
    watch_interrupts(); // before there is anything to tidy up
    RunWriter writer(options.out, scene, {exports.vtp, options.every, {}, threads});
    RunTable table(*scene);
    std::unique_ptr<MetricsEngine> metrics;
    ProgressDisplay progress = ProgressDisplay::for_user(options.quiet);
    const auto on_frame = [&](const Recording& recording, const FramePtr& frame) {
        if (!metrics) {
            metrics = std::make_unique<MetricsEngine>(recording, threads);
            writer.set_attachments(recording.attachments());
        }
        const std::vector<std::vector<double>> values = metrics->measure(*frame);
        table.add(*frame, values);
        writer.add_frame(frame, values,
                         exports.vtp ? point_arrays(*metrics, scene->muscles.size())
                                     : std::vector<std::vector<NamedArray>>{});
    };
    const RecordingPtr recording = run_scene(scene, {threads, loaded.notes}, progress, on_frame);
    std::vector<const FibreSeries*> series;
    for (int m = 0; metrics != nullptr && m < static_cast<int>(scene->muscles.size()); ++m) {
        const FibreMeasure* fibres = metrics->muscle(m).fibres();
        series.push_back(fibres != nullptr ? &fibres->series() : nullptr);
    }
    std::vector<std::string> told;
    const auto exports_beside = [&](const std::filesystem::path& place) {
        if (recording->state() == RunState::cancelled)
            return;
#ifdef FASCICLE_HAS_VIEW
        if (exports.png) {
            progress.update({"pictures", 0, 0, 0}, steady_seconds());
            output::write_run_pictures(*recording, place);
            progress.finish();
        }
#endif
        told = write_exports(exports, options.export_options, recording, place, options.every, threads,
                             progress);
    };
    if (recording->frame_count() > 0)
        writer.finish(*recording, series, exports_beside);
    if (recording->state() == RunState::cancelled)
        report_cancelled(*recording, options.out);
    if (!options.quiet) {
        for (const std::string& note : recording->notes())
            std::cout << "note: " << one_line(note) << '\n';
        table.print(std::cout, *recording);
        for (const std::string& sentence : told)
            std::cout << one_line(sentence) << '\n';
        std::cout << "written to " << one_line(options.out) << '\n';
    }
    return 0;
}

} // namespace

std::function<int()> add_simulate(CLI::App& app) {
    const auto options = std::make_shared<SimulateOptions>();
    add_source_options(app, options->source);
    add_text(app, "--out", options->out, "DIR", "Folder for everything that is written");
    add_solve_options(app, options->solve);
    add_texts(app, "--export", options->exports, "KEY,...",
              "What to write beside the tables, of " + export_keys());
    add_whole(app, "--every", options->every, 1, 1000000, "K",
              "Write every K-th frame's surfaces, and the last; of exports, too");
    add_export_options(app, options->export_options);
    app.add_flag("--quiet", options->quiet, "No progress and no closing table");
    return [options] { return simulate(*options); };
}

} // namespace fascicle::app
