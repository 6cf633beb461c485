// fascicle convert IN OUT: a mesh file in another format, as it stands; tables that have a natural pair.

#include "app/cli/command.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/base/interrupt.hpp"
#include "fascicle/base/param_table.hpp"
#include "fascicle/base/text.hpp"
#include "fascicle/geometry/axis_mapping.hpp"
#include "fascicle/geometry/bounding_box.hpp"
#include "fascicle/io/attachment_file.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/load_scene.hpp"
#include "fascicle/io/mesh_bodies.hpp"
#include "fascicle/io/mesh_convert.hpp"
#include "fascicle/io/mesh_stamp.hpp"
#include "fascicle/io/osim_request.hpp"
#include "fascicle/io/run_reader.hpp"
#include "fascicle/io/storage_write.hpp"
#include "fascicle/io/unit_guess.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <optional>

namespace fascicle::app {

namespace {

namespace fs = std::filesystem;

struct ConvertOptions {
    std::string in, out, units, scale, axes = "as_is", body;
};

std::string extension_of(const fs::path& path) {
    std::string text = path.extension().string();
    for (char& c : text)
        if (c >= 'A' && c <= 'Z')
            c = static_cast<char>(c - 'A' + 'a');
    return text;
}

bool is_table(const fs::path& path) {
    const std::string extension = extension_of(path);
    return extension == ".mot" || extension == ".sto" || extension == ".csv" || extension == ".tsv";
}

/// Error (usage) when both names are one file, also through links.
void require_two_files(const ConvertOptions& options) {
    std::error_code code;
    const bool same = fs::equivalent(options.in, options.out, code) ||
                      fs::weakly_canonical(options.in, code) == fs::weakly_canonical(options.out, code);
    if (same && !options.in.empty())
        throw_error(options.out, "the output is the input", "another file", ErrorKind::usage);
}

std::string counted(std::size_t n, const char* one, const char* many) {
    return std::to_string(n) + ' ' + (n == 1 ? one : many);
}

/// "triangles 12, arrays depth (1)": what a file holds.
std::string contents(const MeshData& data) {
    const Points& points = data.mesh.positions.empty() ? data.lines.points : data.mesh.positions;
    std::string text = counted(points.size(), "vertex", "vertices") + ", " +
                       counted(data.mesh.triangles.size(), "triangle", "triangles");
    if (!data.lines.lines.empty())
        text += ", " + counted(data.lines.lines.size(), "line", "lines");
    std::string names;
    for (const auto* arrays : {&data.point_arrays, &data.line_arrays})
        for (const NamedArray& array : *arrays)
            names += (names.empty() ? "" : ", ") + array.name;
    return text + (names.empty() ? "" : "; arrays " + names);
}

/// Millimetres in a unit of the file, and how that is known.
std::pair<double, std::string> unit_of_file(const MeshStamp& stamp, const MeshData& data) {
    if (const auto said = stamp.hints.millimetres)
        return {*said, "1 unit = " + number_text(*said) + " mm, as the file says"};
    BoundingBox box;
    for (const Points* points : {&data.mesh.positions, &data.lines.points})
        for (const Vec3& p : *points)
            box.add(p);
    const LengthUnit unit = guess_length_unit(box.diagonal()).unit;
    return {millimetres_per_unit(unit), std::string(to_text(unit)) + ", guessed from the size"};
}

void scale(MeshData& data, double factor, const std::string& file) {
    for (Points* points : {&data.mesh.positions, &data.lines.points})
        for (Vec3& p : *points) {
            p *= factor;
            if (!p.allFinite())
                throw_error(file, "a coordinate is not finite after scaling by " + number_text(factor));
        }
}

/// What was asked for by --scale, or --units from what the file is in. The stamp says then what the coordinates are in.
void scale_as_asked(const ConvertOptions& options, MeshStamp& stamp, MeshData& data,
                    std::vector<std::string>& notes) {
    std::optional<double>& said = stamp.hints.millimetres;
    if (!options.scale.empty()) {
        double factor = 0;
        if (!parse_number(options.scale, factor) || !(factor > 0))
            throw_error("--scale", "got '" + options.scale + "'", "a number above 0", ErrorKind::usage);
        notes.push_back("scaled by " + number_text(factor));
        scale(data, factor, options.in);
        if (said && std::isnormal(*said / factor))
            said = *said / factor;
        else
            said.reset();
    } else if (!options.units.empty()) {
        const auto [millimetres, why] = unit_of_file(stamp, data);
        said = options.units == "mm" ? 1.0 : 1000.0;
        const double factor = millimetres / *said;
        notes.push_back("scaled by " + number_text(factor) + " to " + options.units + " (" + why + ")");
        scale(data, factor, options.in);
    }
}

/// "RAS, z up": what a file says of its axes.
std::string said_of_axes(const MeshStamp& stamp) {
    std::string text = stamp.hints.space ? to_text(*stamp.hints.space) : "";
    if (stamp.up)
        text += (text.empty() ? "" : ", ") + std::string(1, *stamp.up) + " up";
    return text;
}

/// What was asked for by --axes. Vectors that are known as such turn along.
void turn_as_asked(const ConvertOptions& options, MeshStamp& stamp, MeshData& data,
                   std::vector<std::string>& notes) {
    const AxisMapping mapping = parse_axis_mapping(options.axes);
    if (mapping == AxisMapping::as_is)
        return;
    const Mat3 m = axis_matrix(mapping); // entries are 0 and +-1: the product is exact
    for (Points* points : {&data.mesh.positions, &data.lines.points})
        for (Vec3& p : *points)
            p = m * p;
    std::string left;
    for (NamedArray& array : data.point_arrays) {
        if (array.name == "Normals" && array.components == 3)
            for (std::size_t i = 0; i + 2 < array.values.size(); i += 3) {
                const Vec3 n = m * Vec3(array.values[i], array.values[i + 1], array.values[i + 2]);
                std::copy(n.data(), n.data() + 3, array.values.begin() + static_cast<std::ptrdiff_t>(i));
            }
        else if (array.components == 3 && array.name != "RGB")
            left += (left.empty() ? "" : ", ") + array.name;
    }
    for (const AxisMappingRow& row : axis_mappings())
        if (row.mapping == mapping)
            notes.push_back(std::string("turned: ") + row.label);
    if (!left.empty())
        notes.push_back("not turned: values of arrays of three: " + left);
    std::optional<MeshSpace>& space = stamp.hints.space;
    if (mapping == AxisMapping::ras_to_lps) { // half a turn, which is its own inverse
        if (space == MeshSpace::lps)
            notes.push_back("the file says LPS: it is RAS now");
        space = space == MeshSpace::lps ? MeshSpace::ras : MeshSpace::lps;
        stamp.up = 'z';
        return;
    }
    const bool to_lps = mapping == AxisMapping::opensim_to_lps || mapping == AxisMapping::y_up_to_lps;
    if (stamp.up == (to_lps ? 'z' : 'y') || (space && (to_lps || *space == MeshSpace::ras)))
        notes.push_back("the file says otherwise: " + said_of_axes(stamp));
    space = to_lps ? std::optional(MeshSpace::lps) : std::nullopt;
    stamp.up = to_lps ? 'z' : 'y';
}

/// Outlines of attachments as closed lines, in mm; arrays tell the kind (as in areas: 1 origin, 2 insertion) and the outline.
MeshData outline_lines(const std::string& bytes, const std::string& file, std::vector<std::string>& notes) {
    MeshData data;
    NamedArray kinds{"attachment", 1, {}}, numbers{"outline", 1, {}};
    std::string bones;
    for (const AttachmentOutline& outline : read_attachments(bytes, file, LengthUnit::millimetre)) {
        if (outline.points.size() < 2)
            continue;
        std::vector<int>& line = data.lines.lines.emplace_back();
        for (const Vec3& p : outline.points) {
            line.push_back(static_cast<int>(data.lines.points.size()));
            data.lines.points.push_back(p);
        }
        line.push_back(line.front());
        kinds.values.push_back(outline.kind == AttachmentKind::origin ? 1 : 2);
        numbers.values.push_back(static_cast<double>(numbers.values.size()));
        bones += (bones.empty() ? "" : ", ") + outline.bone;
    }
    data.line_arrays = {std::move(kinds), std::move(numbers)};
    notes.push_back("outlines are closed lines in mm; array attachment: 1 origin, 2 insertion");
    notes.push_back("dropped: names of the bones: " + bones);
    return data;
}

void print(const std::string& out, const std::string& what, const std::vector<std::string>& notes) {
    std::cout << one_line(out) << ": " << one_line(what) << '\n';
    for (const std::string& note : notes)
        std::cout << "  " << one_line(note) << '\n';
}

void convert_mesh(const ConvertOptions& options, const std::string& bytes) {
    const MeshFormat& format = format_for_writing(options.out);
    const MeshFormat* from = nullptr;
    std::vector<std::string> notes;
    const bool outlines = extension_of(options.in) == ".csv" || extension_of(options.in) == ".tsv";
    MeshData data =
        outlines ? outline_lines(bytes, options.in, notes) : read_mesh_data(bytes, options.in, &from);
    MeshStamp stamp;
    if (outlines)
        stamp.hints.millimetres = 1;
    else
        stamp = find_mesh_stamp(bytes);
    if (const Animation bodies = outlines ? Animation() : read_bodies(bytes, options.in);
        !options.body.empty())
        data = body_mesh(bodies, options.body, options.in);
    else if (bodies.bodies.size() > 1)
        notes.push_back("all bodies become one mesh: " + body_names(bodies) + "; --body NAME takes one");
    for (const std::string& note : data.notes)
        if (note.find("bodies are taken as one mesh") == std::string::npos) // said with their names above
            notes.push_back(note);
    scale_as_asked(options, stamp, data, notes);
    turn_as_asked(options, stamp, data, notes);
    const std::string extension = format.extensions.front();
    const bool says_any_unit = extension == ".usda" && stamp.hints.millimetres.has_value();
    if (format.holds.metres && !says_any_unit && unit_of_file(stamp, data).first != 1000)
        notes.push_back(format.name +
                        " says metres, which the file does not seem to be in: --units m scales it");
    if (extension == ".glb" && stamp.up != 'y')
        notes.push_back("glTF says that y is up; " +
                        std::string(stamp.up || stamp.hints.space ? "z is up here, and nothing was turned"
                                                                  : "nothing was turned") +
                        ": --axes lps_to_y_up turns what is z up");
    for (std::string& lost : lost_of_stamp(format, stamp))
        notes.push_back(std::move(lost));
    for (std::string& lost : fit_to_format(data, format))
        notes.push_back(std::move(lost));
    const std::atomic<bool>& interrupted = watch_interrupts(); // before there is anything to tidy up
    AtomicFile file(options.out);
    try {
        write_stamped(file.stream(), format, data, stamp);
    } catch (const Error& error) { // what the format cannot hold at all
        throw_error(options.out, error.what());
    }
    if (interrupted)
        throw Cancelled();
    file.commit();
    print(options.out,
          (from != nullptr ? from->name : "attachment outlines") + " to " + format.name + ", " +
              contents(data),
          notes);
}

void convert_table(const ConvertOptions& options, const std::string& bytes) {
    if (!options.scale.empty() || !options.units.empty() || options.axes != "as_is" || !options.body.empty())
        throw_error("convert", "--units, --scale, --axes and --body are for meshes", {}, ErrorKind::usage);
    const StorageTable table = read_storage(bytes, options.in);
    const std::string extension = extension_of(options.out);
    const bool csv = extension == ".csv";
    const std::atomic<bool>& interrupted = watch_interrupts();
    AtomicFile file(options.out);
    csv ? write_storage_csv(file.stream(), table) : write_storage(file.stream(), table);
    if (interrupted)
        throw Cancelled();
    file.commit();
    std::vector<std::string> notes = table.notes;
    notes.push_back(std::string("angles stay in ") + (table.in_degrees ? "degrees" : "radians"));
    print(options.out,
          "table of " + counted(table.row_count(), "row", "rows") + " and " +
              counted(table.columns.size(), "column", "columns"),
          notes);
}

int run(const ConvertOptions& options) {
    if (options.in.empty() || options.out.empty())
        throw_error("convert", "needs an input and an output", "convert IN OUT", ErrorKind::usage);
    if (!options.scale.empty() && !options.units.empty())
        throw_error("convert", "--units and --scale say the same in two ways", "one of them",
                    ErrorKind::usage);
    if (!options.units.empty() && options.units != "mm" && options.units != "m")
        throw_error("--units", "got '" + options.units + "'", "mm or m", ErrorKind::usage);
    parse_axis_mapping(options.axes);
    const std::string extension = extension_of(options.out);
    const bool table = extension == ".csv" || extension == ".mot" || extension == ".sto";
    if (!table)
        format_for_writing(options.out); // before anything is read
    require_two_files(options);
    if (is_run_folder(options.in))
        throw_error(options.in, "a run is more than a mesh",
                    "fascicle export RUN --out FILE, or one file of its frames", ErrorKind::usage);
    const std::string bytes = read_file(options.in);
    if (!table) {
        convert_mesh(options, bytes);
    } else if (is_table(options.in)) {
        convert_table(options, bytes);
    } else {
        throw_error(options.out, "a mesh cannot be written as a table", "a mesh format", ErrorKind::usage);
    }
    return 0;
}

} // namespace

std::function<int()> add_convert(CLI::App& app) {
    const auto options = std::make_shared<ConvertOptions>();
    app.add_option("IN", options->in,
                   "Mesh file (" + mesh_format_names() +
                       "), attachment outlines (.csv), motion (.mot, .sto)");
    app.add_option("OUT", options->out,
                   "The extension tells the format; a motion can go to .mot, .sto or .csv");
    app.add_option("--units", options->units,
                   "Write in mm or m: from what the file says, else from the guess by its size");
    app.add_option("--scale", options->scale, "Multiply all coordinates by this");
    std::string keys;
    for (const AxisMappingRow& row : axis_mappings())
        keys += (keys.empty() ? "" : ", ") + std::string(row.key);
    app.add_option("--axes", options->axes, "Turn into other axes, never mirrored: " + keys);
    app.add_option("--body", options->body, "One body of a .glb, .usda, or .obj with objects, by its name");
    return [options] { return run(*options); };
}

} // namespace fascicle::app
