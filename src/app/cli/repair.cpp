// fascicle repair IN OUT: a closed, manifold, consistently oriented mesh, or the reason why not.

#include "app/cli/command.hpp"
#include "app/cli/options.hpp"
#include "app/cli/progress.hpp"
#include "app/cli/repair_report.hpp"
#include "app/cli/run_scene.hpp"
#include "fascicle/base/interrupt.hpp"
#include "fascicle/base/parallel.hpp"
#include "fascicle/geometry/bounding_box.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/format_registry.hpp"
#include "fascicle/io/load_scene.hpp"
#include "fascicle/io/mesh_convert.hpp"
#include "fascicle/io/mesh_file.hpp"
#include "fascicle/io/mesh_stamp.hpp"
#include "fascicle/io/unit_guess.hpp"

#include <cmath>
#include <iostream>

namespace fascicle::app {

namespace {

namespace fs = std::filesystem;

constexpr double automatic = -1e300;

struct RepairCommand {
    std::string in, out, report, units;
    double weld_mm = automatic, edge_mm = 0, volume_percent = 0.5, islands = 0.01;
    int fill = -1, smooth = 0, triangles = 0, threads = 0;
    bool untangle = false, quiet = false;
};

bool same_file(const std::string& a, const std::string& b) {
    std::error_code error;
    return fs::equivalent(a, b, error) || fs::weakly_canonical(a, error) == fs::weakly_canonical(b, error);
}

[[noreturn]] void wrong(const std::string& option, double value, const std::string& expected) {
    throw_error(option, "got " + std::to_string(value), expected, ErrorKind::usage);
}

RepairOptions options_of(const RepairCommand& command, double mm_per_unit) {
    RepairOptions options;
    if (command.weld_mm >= 0)
        options.weld = command.weld_mm / mm_per_unit;
    if (command.fill >= 0) {
        options.fill_edges = command.fill;
        options.fill_share = std::numeric_limits<double>::infinity(); // asked for
    }
    options.island_share = command.islands;
    options.smooth_passes = command.smooth;
    options.edge_length = command.edge_mm / mm_per_unit;
    options.triangles = command.triangles;
    options.volume_share = command.volume_percent / 100;
    options.untangle = command.untangle;
    options.threads = command.threads > 0 ? command.threads : hardware_threads();
    return options;
}

void check(const RepairCommand& command) {
    if (command.in.empty() || command.out.empty())
        throw_error("repair", "needs two files", "repair IN OUT", ErrorKind::usage);
    format_for_writing(command.out);
    for (const std::string* file : {&command.out, &command.report})
        if (!file->empty())
            check_output_name(*file); // before anything is written
    if (same_file(command.in, command.out))
        throw_error(command.out, "is the input", "another file: an input is never changed", ErrorKind::usage);
    if (!command.report.empty() &&
        (same_file(command.report, command.in) || same_file(command.report, command.out)))
        throw_error("--report", "is the input or the output", "another file", ErrorKind::usage);
    if (command.edge_mm > 0 && command.triangles > 0)
        throw_error("repair", "both --edge and --triangles", "one of them", ErrorKind::usage);
    if (command.weld_mm != automatic && !(command.weld_mm >= 0))
        wrong("--weld", command.weld_mm, "a length in mm, 0 or more");
    if (!(command.islands >= 0 && command.islands <= 1))
        wrong("--islands", command.islands, "a share from 0 to 1");
    if (!(command.volume_percent > 0 && command.volume_percent <= 100))
        wrong("--keep-volume", command.volume_percent, "percent, above 0 and up to 100");
    if (!(command.edge_mm >= 0))
        wrong("--edge", command.edge_mm, "a length in mm, above 0");
}

/// Arrays follow their vertices.
MeshData carried(const MeshData& data, RepairResult& result) {
    MeshData out;
    out.mesh = std::move(result.mesh);
    for (const NamedArray& array : data.point_arrays)
        out.point_arrays.push_back(
            {array.name, array.components,
             carried_values(result.origins, array.values, static_cast<std::size_t>(array.components))});
    return out;
}

int repair_file(const RepairCommand& command) {
    check(command);
    ProgressDisplay progress = ProgressDisplay::for_user(command.quiet);
    JobControl control;
    control.cancel = &watch_interrupts();
    const double begun = steady_seconds();
    control.report = [&](std::string_view stage, double fraction) {
        constexpr double patience_seconds = 1; // most meshes are done by then
        if (const double now = steady_seconds(); now > begun + patience_seconds)
            progress.update({std::string(stage), fraction, 0, 0}, now);
    };
    const std::string bytes = read_file(command.in);
    const MeshData data = read_mesh_data(bytes, command.in);
    const MeshStamp stamp = find_mesh_stamp(bytes);
    if (data.mesh.triangles.empty())
        throw_error(command.in, "the file holds no triangles", "a surface");
    RepairReport report;
    report.in = command.in;
    report.out = command.out;
    const double diagonal = bounding_box(data.mesh.positions, data.mesh.triangles).diagonal();
    const double said = stamp.hints.millimetres.value_or(0);
    const bool known = said == 1 || said == 1000;
    report.unit = !command.units.empty() ? command.units
                  : known                ? (said == 1 ? "mm" : "m")
                                         : to_text(guess_length_unit(diagonal).unit);
    report.unit_guessed = command.units.empty() && !known;
    report.options = options_of(command, report.unit == "m" ? 1000 : 1);
    report.options.unit = report.unit;
    report.notes = data.notes;
    if (!data.lines.lines.empty())
        report.notes.push_back("polylines are not written");
    RepairResult result;
    try {
        result = repair(data.mesh, report.options, control);
    } catch (const Error& error) {
        throw_error(command.in, error.what());
    }
    progress.finish();
    if (result.good()) {
        MeshData out = carried(data, result);
        for (std::string& lost : fit_to_format(out, format_for_writing(command.out)))
            report.notes.push_back(std::move(lost));
        report.arrays = static_cast<int>(out.point_arrays.size());
        for (std::string& lost : lost_of_stamp(format_for_writing(command.out), stamp))
            report.notes.push_back(std::move(lost));
        write_stamped_file(command.out, out, stamp);
    }
    if (!command.report.empty())
        write_file(command.report, to_json(report, result));
    if (!command.quiet)
        print(std::cout, report, result);
    if (!result.good())
        throw_error(command.in, "cannot be repaired: " + result.reason);
    return 0;
}

} // namespace

std::function<int()> add_repair(CLI::App& app) {
    const auto command = std::make_shared<RepairCommand>();
    app.add_option("IN", command->in, "Mesh to repair; it is never changed");
    app.add_option("OUT", command->out, "Where the repaired mesh goes; its extension tells the format");
    add_number(
        app, "--weld", command->weld_mm, "MM",
        "Border vertices nearer than this become one, mm (default: a thousandth of the mean edge length)");
    add_whole(
        app, "--fill", command->fill, 0, RepairOptions::longest_hole, "EDGES",
        "Fill holes with up to so many edges, however large they are (default: up to 100 edges and 15 % of "
        "the area); 0: none");
    add_number(app, "--islands", command->islands, "SHARE",
               "Drop parts with less than this share of the largest part's area, 0 to 1 (default 0.01)");
    add_whole(app, "--smooth", command->smooth, 0, 10000, "PASSES",
              "Smooth without shrinking (Taubin 1995) so many times (default 0)");
    add_number(app, "--edge", command->edge_mm, "MM", "Remesh to this edge length, mm");
    add_whole(app, "--triangles", command->triangles, 4, 20000000, "N", "Remesh to this number of triangles");
    add_number(app, "--keep-volume", command->volume_percent, "PERCENT",
               "Largest change of the volume by remeshing (default 0.5); more is an error");
    app.add_flag("--untangle", command->untangle,
                 "Try to part triangles that cross by smoothing around them; what is left is told");
    add_choice(app, "--units", command->units, {"mm", "m"},
               "Unit of the mesh (default: guessed from its size)");
    add_text(app, "--report", command->report, "FILE.json", "What was found, done and left, for programs");
    add_whole(app, "--threads", command->threads, 1, 4096, "N",
              "Threads (default: all of the machine); never changes a result");
    app.add_flag("--quiet", command->quiet, "No progress and no table");
    return [command] { return repair_file(*command); };
}

} // namespace fascicle::app
