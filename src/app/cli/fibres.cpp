// fascicle fibres SOURCE [options] --out DIR: decomposes the muscles of a scene into fibres at rest.

#include "app/cli/command.hpp"
#include "app/cli/options.hpp"
#include "app/cli/run_scene.hpp"
#include "app/cli/source_options.hpp"
#include "fascicle/anatomy/fibre_architecture.hpp"
#include "fascicle/base/interrupt.hpp"
#include "fascicle/base/text.hpp"
#include "fascicle/geometry/volume.hpp"
#include "fascicle/io/csv.hpp"
#include "fascicle/io/disk_cache.hpp"
#include "fascicle/io/fibre_files.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/mesh_stamp.hpp"
#include "fascicle/io/output_folder.hpp"
#include "fascicle/io/staged_files.hpp"
#include "fascicle/simulation/prepare.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>

namespace fascicle::app {

namespace {

namespace fs = std::filesystem;

struct FibresOptions {
    SourceOptions source;
    SolveOptions solve;
    std::string out;
    bool quiet = false;
};

/// A method that the scene can do, when none was asked for.
void choose_method(Scene& scene) {
    if (scene.parameters.get_choice("fibres.method") != "none")
        return;
    const bool superficial = std::all_of(scene.muscles.begin(), scene.muscles.end(),
                                         [](const Muscle& m) { return m.surface_fibres != nullptr; });
    scene.parameters.set_text("fibres.method", superficial && !scene.muscles.empty() ? "chmd" : "kukacka");
}

struct Row {
    std::string muscle;
    int fibres = 0, segments = 0;
    MuscleArchitecture architecture;
    double length_sd_mm = 0, seconds = 0, after_field = 0;
};

double standard_deviation(const std::vector<double>& values) {
    double mean = 0, sum = 0;
    for (const double v : values)
        mean += v / double(values.size());
    for (const double v : values)
        sum += (v - mean) * (v - mean);
    return values.size() > 1 ? std::sqrt(sum / double(values.size() - 1)) : 0.0;
}

Row make_row(const Scene& scene, std::size_t m, const PreparedMuscle& prepared, int threads) {
    const FibreModel& model = *prepared.fibres;
    const TriMesh& surface = *prepared.problem.surface;
    const double unit_mm = millimetres_per_unit(scene.unit);
    Row row{scene.muscles[m].name, model.rest.count, model.rest.segments, {}, 0, 0, 0};
    row.architecture = muscle_architecture(model.rest, signed_volume(surface.positions, surface.triangles),
                                           unit_mm, row.muscle, threads);
    row.length_sd_mm = unit_mm * standard_deviation(fibre_lengths(model.rest));
    for (const auto& [stage, seconds] : model.seconds) {
        row.seconds += seconds;
        if (stage != "field")
            row.after_field += seconds;
    }
    return row;
}

void write_table(const fs::path& path, const std::string& method, const std::vector<Row>& rows) {
    AtomicFile file(path);
    CsvWriter csv(file.stream());
    for (const char* name :
         {"muscle", "method", "fibres", "segments", "length_mean_mm", "length_sd_mm", "length_min_mm",
          "length_max_mm", "pennation_origin_deg", "pennation_insertion_deg", "pcsa_cm2", "cover_percent",
          "seconds", "seconds_after_field"})
        csv.text(name);
    csv.end_row();
    for (const Row& row : rows) {
        const MuscleArchitecture& a = row.architecture;
        csv.text(row.muscle).text(method).integer(row.fibres).integer(row.segments);
        for (const double value :
             {a.length_mean_mm, row.length_sd_mm, a.length_min_mm, a.length_max_mm, a.pennation_origin_deg,
              a.pennation_insertion_deg, a.pcsa_cm2, a.cover_percent, row.seconds, row.after_field})
            csv.number(value);
        csv.end_row();
    }
    file.commit();
}

void print_table(const std::string& method, const std::vector<Row>& rows) {
    std::size_t width = std::string("muscle").size();
    for (const Row& row : rows)
        width = std::max(width, row.muscle.size());
    const auto name = [&](const std::string& text) {
        return one_line(text) + std::string(width - text.size(), ' ');
    };
    std::cout << "method " << method << '\n'
              << name("muscle")
              << "  fibres  segments  length mm (sd)  pennation deg   PCSA cm2  cover %  seconds\n"
              << std::fixed;
    for (const Row& row : rows)
        std::cout << name(row.muscle) << std::setw(8) << row.fibres << std::setw(10) << row.segments
                  << std::setprecision(1) << std::setw(9) << row.architecture.length_mean_mm << " ("
                  << std::setw(4) << row.length_sd_mm << ")" << std::setw(14)
                  << row.architecture.pennation_mean_deg << std::setw(12) << row.architecture.pcsa_cm2
                  << std::setprecision(0) << std::setw(9) << row.architecture.cover_percent
                  << std::setprecision(3) << std::setw(9) << row.seconds << '\n';
}

int fibres(const FibresOptions& options) {
    if (options.out.empty())
        throw_error("fibres", "no output folder", "--out DIR", ErrorKind::usage);
    if (!options.source.request.lines.empty())
        throw_error("--lines", "fibres at rest are made without line muscles",
                    "'fascicle simulate' or 'fascicle render' for it", ErrorKind::usage);
    LoadedScene loaded = load(options.source, options.solve);
    Scene& scene = loaded.scene;
    choose_method(scene);
    without_inputs(options.out, scene, input_files(options.source, options.solve));
    watch_interrupts(); // before there is anything to tidy up
    StagedFiles staged(options.out);
    const fs::path out = staged.place();
    const std::string method = scene.parameters.get_choice("fibres.method");
    const int threads = thread_count(options.solve);
    ProgressDisplay progress = ProgressDisplay::for_user(options.quiet);
    JobControl control;
    control.cancel = &watch_interrupts();
    control.report = [&](std::string_view stage, double fraction) {
        progress.update({std::string(stage), fraction, 0, 0}, steady_seconds());
    };
    const auto cache = open_cache();
    const PreparedScene prepared = prepare_scene(scene, threads, control, cache.get());
    progress.finish();
    std::vector<Row> rows;
    std::vector<FibreSeries> series;
    for (std::size_t m = 0; m < scene.muscles.size(); ++m) {
        rows.push_back(make_row(scene, m, prepared.muscles[m], threads));
        series.emplace_back(scene.muscles[m].name, millimetres_per_unit(scene.unit), flexion_sign(scene));
        series.back().append(0, scene.timeline.angle_rad(0), prepared.muscles[m].fibres->rest);
    }
    std::vector<const FibreSeries*> pointers;
    for (std::size_t m = 0; m < scene.muscles.size(); ++m) {
        const fs::path file = out / fibre_file(scene.muscles[m].name, 0);
        write_stamped_file(file, fibre_lines(series[m], 0, prepared.muscles[m].fibres->rest),
                           stamp_of(scene.unit));
        pointers.push_back(&series[m]);
    }
    write_fibre_table(out / "fibres.csv", pointers);
    write_table(out / "architecture.csv", method, rows);
    staged.commit(scene);
    if (!options.quiet) {
        for (const std::vector<std::string>& notes : {loaded.notes, prepared.notes})
            for (const std::string& note : notes)
                std::cout << "note: " << one_line(note) << '\n';
        print_table(method, rows);
        std::cout << "written to " << one_line(options.out) << '\n';
    }
    return 0;
}

} // namespace

std::function<int()> add_fibres(CLI::App& app) {
    const auto options = std::make_shared<FibresOptions>();
    add_source_options(app, options->source);
    add_text(app, "--out", options->out, "DIR", "Folder for everything that is written");
    add_solve_options(app, options->solve);
    app.add_flag("--quiet", options->quiet, "No progress and no closing table");
    return [options] { return fibres(*options); };
}

} // namespace fascicle::app
