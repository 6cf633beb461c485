// fascicle lines --osim MODEL --motion FILE --out DIR: line muscles of an OpenSim model over a motion.

#include "app/cli/command.hpp"
#include "app/cli/lines_output.hpp"
#include "app/cli/options.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/base/interrupt.hpp"
#include "fascicle/base/parallel.hpp"
#include "fascicle/base/suggest.hpp"
#include "fascicle/base/text.hpp"
#include "fascicle/geometry/bounding_box.hpp"
#include "fascicle/io/load_scene.hpp"
#include "fascicle/io/mesh_file.hpp"
#include "fascicle/io/mesh_units.hpp"
#include "fascicle/io/osim_file.hpp"
#include "fascicle/io/staged_files.hpp"
#include "fascicle/io/storage_file.hpp"
#include "fascicle/io/unit_guess.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>

namespace fascicle::app {
namespace {

struct LinesOptions {
    std::string osim, motion, coordinate, out;
    std::vector<std::string> bones, exports;
    int threads = 0;
    bool quiet = false;
};

std::string joined_names(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names)
        text += (text.empty() ? "" : ", ") + name;
    return text;
}

/// The coordinate that moment arms are about; -1: none. Without a name the only rotational one that the motion moves.
int choose_coordinate(const LinesOptions& options, const Skeleton& skeleton,
                      const std::vector<std::vector<double>>& values, std::vector<std::string>& notes) {
    std::vector<std::string> rotational;
    for (const Coordinate& c : skeleton.coordinates)
        if (c.kind == CoordinateKind::rotational)
            rotational.push_back(c.name);
    if (!options.coordinate.empty()) {
        const int index = skeleton.coordinate_index(options.coordinate);
        if (index < 0 ||
            skeleton.coordinates[static_cast<std::size_t>(index)].kind != CoordinateKind::rotational)
            throw_error("--coordinate",
                        "'" + options.coordinate + "' is no rotational coordinate of the model" +
                            did_you_mean(options.coordinate, rotational),
                        "one of " + joined_names(rotational), ErrorKind::usage);
        return index;
    }
    std::vector<int> moving;
    for (std::size_t c = 0; c < skeleton.coordinates.size(); ++c)
        if (skeleton.coordinates[c].kind == CoordinateKind::rotational &&
            std::any_of(values.begin(), values.end(),
                        [&](const std::vector<double>& q) { return std::abs(q[c] - values[0][c]) > 1e-9; }))
            moving.push_back(static_cast<int>(c));
    if (moving.size() == 1)
        return moving.front();
    notes.push_back(std::string(moving.empty() ? "nothing turns" : "several coordinates turn") +
                    ": --coordinate says about which one moment arms are wanted");
    return -1;
}

/// BODY=MESH, the mesh in the body's frame.
std::vector<BodyObstacle> read_bones(const LinesOptions& options, const Skeleton& skeleton,
                                     std::vector<std::string>& notes) {
    std::vector<BodyObstacle> obstacles;
    for (const std::string& text : options.bones) {
        const std::size_t cut = text.find('=');
        const std::string body = text.substr(0, cut);
        if (cut == std::string::npos || cut + 1 == text.size())
            throw_error("--bone", "got '" + text + "'", "BODY=MESH", ErrorKind::usage);
        std::vector<std::string> names;
        for (const Body& b : skeleton.bodies)
            names.push_back(b.name);
        const int index = skeleton.body_index(body);
        if (index < 0)
            throw_error("--bone", "there is no body '" + body + "'" + did_you_mean(body, names),
                        "one of " + joined_names(names), ErrorKind::usage);
        const std::string path = text.substr(cut + 1);
        MeshFile file = read_mesh_file(path);
        if (file.mesh.triangles.empty())
            throw_error(path, "holds no surface", "a bone of triangles");
        const double diagonal = bounding_box(file.mesh.positions, file.mesh.triangles).diagonal();
        const LengthUnit unit = guess_length_unit(diagonal).unit;
        const auto said = read_mesh_hints(path).millimetres;
        const bool stated = said && stated_unit_fits(*said, diagonal);
        for (Vec3& x : file.mesh.positions)
            x *= (stated ? *said : millimetres_per_unit(unit)) / 1000;
        notes.push_back("bone " + body + ": " + std::to_string(file.mesh.triangle_count()) + " triangles, " +
                        (stated ? unit_words(*said) + ", as the file says"
                                : "in " + std::string(to_text(unit)) + " by their size"));
        obstacles.push_back({index, std::make_shared<const BoneObstacle>(file.mesh)});
    }
    return obstacles;
}

void check(const LinesOptions& options) {
    const auto need = [](const std::string& value, const char* option) {
        if (value.empty())
            throw_error("lines", std::string("no ") + option, "--osim MODEL --motion FILE --out DIR",
                        ErrorKind::usage);
    };
    need(options.osim, "--osim");
    need(options.motion, "--motion");
    need(options.out, "--out");
    for (const std::string& list : options.exports)
        for (const std::string& word : split(list, ','))
            if (word != "vtp" && word != "csv")
                throw_error("--export", "got '" + word + "'", "vtp, csv", ErrorKind::usage);
}

int lines(const LinesOptions& options) {
    check(options);
    const OsimModel file = read_osim_file(options.osim);
    const LineModel& model = file.model;
    if (model.muscles.empty())
        throw_error(options.osim, "the model has no muscles", "muscles with a path");
    const StorageTable table = read_storage_file(options.motion);
    const CoordinateColumns columns = match_coordinates(table, model.skeleton);

    LinesResult result;
    result.notes = file.notes;
    for (const auto* more : {&table.notes, &columns.notes})
        result.notes.insert(result.notes.end(), more->begin(), more->end());
    std::vector<std::vector<double>> values(table.row_count());
    for (std::size_t row = 0; row < values.size(); ++row) {
        coordinate_values(table, columns, row, model.skeleton, values[row]);
        apply_couplers(model.skeleton, values[row]);
    }
    result.coordinate = choose_coordinate(options, model.skeleton, values, result.notes);
    const std::vector<BodyObstacle> bones = read_bones(options, model.skeleton, result.notes);

    const std::size_t muscles = model.muscles.size();
    result.rows.resize(values.size() * muscles);
    const int threads = options.threads > 0 ? options.threads : hardware_threads();
    const std::atomic<bool>& interrupted = watch_interrupts();
    parallel_for(threads, values.size(), 1, [&](std::size_t begin, std::size_t end) {
        LinePathSolver solver(model);
        Posture posture;
        for (std::size_t frame = begin; frame < end; ++frame) {
            if (interrupted)
                throw Cancelled();
            set_posture(model.skeleton, values[frame], posture);
            for (std::size_t m = 0; m < muscles; ++m) {
                LinesRow& row = result.rows[frame * muscles + m];
                row.line = measure_line(solver, static_cast<int>(m), result.coordinate, posture);
                if (result.coordinate >= 0)
                    row.coordinate_value = posture.q[static_cast<std::size_t>(result.coordinate)];
                if (!bones.empty())
                    row.string = measure_string(model, static_cast<int>(m), result.coordinate, posture,
                                                row.line, bones);
            }
        }
    });
    const int time = table.column_index("time");
    for (std::size_t frame = 0; frame < values.size(); ++frame)
        result.times.push_back(time >= 0 ? table.value(frame, static_cast<std::size_t>(time))
                                         : static_cast<double>(frame));
    StagedFiles staged(options.out);
    write_lines_csv(staged.place(), model, result);
    for (const std::string& list : options.exports)
        if (("," + list + ",").find(",vtp,") != std::string::npos)
            write_lines_vtp(staged.place(), model, result);
    std::set<std::filesystem::path> inputs{options.osim, options.motion};
    for (const std::string& bone : options.bones)
        inputs.insert(bone.substr(bone.find('=') + 1));
    staged.commit(inputs);
    if (!options.quiet) {
        print_lines(std::cout, model, result);
        std::cout << "written to " << one_line(options.out) << '\n';
    }
    return 0;
}

} // namespace

std::function<int()> add_lines(CLI::App& app) {
    const auto options = std::make_shared<LinesOptions>();
    add_text(app, "--osim", options->osim, "MODEL.osim", "Model of OpenSim 3 or 4");
    add_text(app, "--motion", options->motion, "FILE.mot", "Coordinates over time: .mot or .sto");
    add_text(app, "--out", options->out, "DIR", "Folder for everything that is written");
    add_text(app, "--coordinate", options->coordinate, "NAME",
             "What moment arms are about; default: the only coordinate that turns");
    add_texts(app, "--bone", options->bones, "BODY=MESH",
              "Surface of a body, in its frame: muscles run over it as strings, too");
    add_texts(app, "--export", options->exports, "vtp,csv", "What to write beside the table: vtp polylines");
    add_whole(app, "--threads", options->threads, 1, 256, "N",
              "Default: all of the machine. Never changes a result");
    app.add_flag("--quiet", options->quiet, "No closing table");
    return [options] { return lines(*options); };
}

} // namespace fascicle::app
