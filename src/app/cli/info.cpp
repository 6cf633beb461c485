// fascicle info MESH...: what a mesh file holds and what is wrong with it.

#include "app/cli/command.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/base/param_table.hpp"
#include "fascicle/base/text.hpp"
#include "fascicle/geometry/bounding_box.hpp"
#include "fascicle/geometry/volume.hpp"
#include "fascicle/io/animation_file.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/format_registry.hpp"
#include "fascicle/io/load_scene.hpp"
#include "fascicle/io/mesh_bodies.hpp"
#include "fascicle/io/mesh_file.hpp"
#include "fascicle/io/mesh_stamp.hpp"
#include "fascicle/io/mesh_units.hpp"
#include "fascicle/io/osim_request.hpp"
#include "fascicle/io/series_file.hpp"
#include "fascicle/io/unit_guess.hpp"
#include "io/formats/point_cache.hpp"

#include <CLI/CLI.hpp>
#include <cmath>
#include <iomanip>
#include <iostream>

namespace fascicle::app {

namespace {

std::string text(double value) {
    char buffer[40];
    std::snprintf(buffer, sizeof buffer, "%.6g", value);
    return buffer;
}

std::string text(const Vec3& p) {
    return text(p.x()) + " " + text(p.y()) + " " + text(p.z());
}

void print(const char* label, const std::string& value) {
    std::cout << "  " << std::left << std::setw(14) << label << one_line(value) << '\n';
}

void print_surface(const MeshFile& file, const std::string& unit) {
    const TriMesh& mesh = file.mesh;
    const MeshReport& report = file.report;
    print("vertices", std::to_string(mesh.vertex_count()));
    print("triangles", std::to_string(mesh.triangle_count()));
    print("components", std::to_string(report.components));
    print("surface", report.closed() ? "closed" : "open");
    const auto measured = [&](double value, char power) {
        return std::isfinite(value) ? text(value) + ' ' + unit + power
                                    : "none, the coordinates are too large";
    };
    print("area", measured(surface_area(mesh.positions, mesh.triangles), '2'));
    print("volume", report.closed() ? measured(signed_volume(mesh.positions, mesh.triangles), '3')
                                    : "none, the surface is open");
}

std::string names_of(const std::vector<NamedArray>& arrays) {
    std::string text;
    for (const NamedArray& array : arrays)
        text += (text.empty() ? "" : ", ") + array.name +
                (array.components > 1 ? " (" + std::to_string(array.components) + ")" : "");
    return text;
}

/// What the header of the file says about itself; nothing acts on it.
void print_stamp(const MeshStamp& stamp) {
    if (stamp.hints.millimetres)
        print("file's unit", "1 unit = " + number_text(*stamp.hints.millimetres) + " mm");
    if (stamp.hints.space)
        print("file's frame", *stamp.hints.space == MeshSpace::ras
                                  ? "RAS (+x right, +y anterior, +z superior)"
                                  : "LPS (+x left, +y posterior, +z superior)");
    if (stamp.up)
        print("up axis", std::string(1, *stamp.up));
}

/// The unit that sizes are shown in: what the file says, else the guess. Says which.
std::string print_unit(const MeshStamp& stamp, const BoundingBox& box) {
    const double diagonal = box.diagonal();
    const UnitGuess guess = guess_length_unit(diagonal);
    const auto said = stamp.hints.millimetres;
    if (!said) {
        if (!box.empty())
            print("unit", std::string(to_text(guess.unit)) + " (guessed from the size" +
                              (guess.sure ? ")" : ", which fits neither m nor mm)"));
        return to_text(guess.unit);
    }
    const std::string unit = *said == 1 ? "mm" : *said == 10 ? "cm" : *said == 1000 ? "m" : "units";
    print("unit", unit + " (as the file says" +
                      (stated_unit_fits(*said, diagonal)
                           ? ")"
                           : ", though the size fits " + std::string(to_text(guess.unit)) + ")"));
    return unit;
}

/// Bodies of a file that has names for them, and its frames.
void print_bodies(const Animation& animation) {
    if (animation.bodies.size() > 1)
        print("bodies", std::to_string(animation.bodies.size()) + ": " + body_names(animation));
    if (animation.frame_count() > 1)
        print("frames", std::to_string(animation.frame_count()) + ", " + text(animation.seconds.front()) +
                            " to " + text(animation.seconds.back()) + " s; what follows is of the first");
}

/// A file of moving points without a mesh: .pc2, .mdd. What the OBJ beside it says of unit and times counts, where there is one.
void print_cache(const std::string& path, const AnimationFormat& format) {
    const std::string bytes = read_file(path);
    const bool pc2 = std::string_view(format.key) == "pc2";
    const io::PointCache cache = pc2 ? io::read_pc2(bytes, path) : io::read_mdd(bytes, path);
    Points points;
    cache.read(0, points, path);
    const BoundingBox box = bounding_box(points);
    std::filesystem::path mesh = path;
    mesh.replace_extension(".obj");
    std::error_code error;
    const bool beside = std::filesystem::exists(mesh, error);
    std::cout << one_line(path) << '\n';
    print("format", format.name);
    print_unit(beside ? find_mesh_stamp(read_head(mesh, 4096)) : MeshStamp{}, box);
    print("points", std::to_string(cache.points));
    print("frames", std::to_string(cache.samples) +
                        (pc2 ? ", from " + text(cache.first_frame) + " in steps of " + text(cache.frame_step)
                             : std::string()));
    if (beside) { // its points have to be the cache's
        const Animation animation = format.read(path);
        print("time", text(animation.seconds.front()) + " to " + text(animation.seconds.back()) + " s");
    } else if (!cache.seconds.empty()) {
        print("time", text(cache.seconds.front()) + " to " + text(cache.seconds.back()) + " s");
    }
    print("mesh", beside ? mesh.filename().string()
                         : "none: " + mesh.filename().string() + " beside it would have the triangles");
    print("box", text(box.min) + " to " + text(box.max) + ", in the first frame");
}

void print_series(const std::string& path, const std::string& bytes) {
    const auto series = parse_series(bytes, path);
    std::cout << one_line(path) << '\n';
    print("format", "ParaView series");
    print("steps", std::to_string(series.size()));
    if (!series.empty()) {
        print("time", text(series.front().first) + " to " + text(series.back().first) + " s");
        print("files", series.front().second + " to " + series.back().second);
    }
}

/// What of an OpenSim model a scene can be made of.
void print_model(const std::string& path) {
    const OsimPreview model = preview_osim(path, {});
    std::cout << one_line(path) << '\n';
    print("format", "OpenSim model, version " + std::to_string(model.version));
    print("name", model.model_name);
    print("unit", "m");
    print("coordinates", std::to_string(model.coordinates));
    print("muscles", std::to_string(model.muscles.size()) + " lines");
    for (const OsimPreview::BodyRow& body : model.bodies) {
        std::string missing;
        for (const std::string& name : body.missing)
            missing += (missing.empty() ? "; not found: " : ", ") + name;
        print("body", body.name + ", " + std::to_string(body.meshes_found) + " meshes" + missing);
    }
    for (const std::string& note : model.notes)
        print("note", note);
}

void print_file(const std::string& path) {
    if (std::filesystem::path(path).extension() == ".osim")
        return print_model(path);
    const AnimationFormat* frames = recognise_animation(path);
    if (frames != nullptr && frames->even_frames) // points alone: there is no mesh to look at
        return print_cache(path, *frames);
    const std::string bytes = read_file(path);
    if (looks_like_series(bytes))
        return print_series(path, bytes);
    const MeshFile file = read_mesh_bytes(bytes, path);
    BoundingBox box = bounding_box(file.mesh.positions, file.mesh.triangles);
    const bool points_alone = file.mesh.triangles.empty();
    for (const Vec3& p : points_alone ? file.mesh.positions : Points())
        box.add(p);
    for (const Vec3& p : file.lines.points)
        box.add(p);
    std::cout << one_line(path) << '\n';
    print("format", file.format);
    const MeshStamp stamp = find_mesh_stamp(bytes);
    const std::string unit = print_unit(stamp, box);
    print_stamp(stamp);
    print_bodies(read_bodies(bytes, path));
    if (frames != nullptr && std::string_view(frames->key) == "obj")
        print("series",
              std::to_string(read_animation(path).frame_count()) + " files of this name and number");
    if (!file.mesh.triangles.empty())
        print_surface(file, unit);
    if (points_alone && !file.mesh.positions.empty())
        print("points", std::to_string(file.mesh.vertex_count()) + ", no surface");
    if (!file.lines.lines.empty())
        print("polylines", std::to_string(file.lines.lines.size()));
    if (!file.point_arrays.empty())
        print("point arrays", names_of(file.point_arrays));
    if (!file.line_arrays.empty())
        print("line arrays", names_of(file.line_arrays));
    if (!box.empty()) {
        print("box", text(box.min) + " to " + text(box.max));
        print("size", text(box.size()) + (std::isfinite(box.diagonal()) ? ", diagonal " + text(box.diagonal())
                                                                        : ", too large to measure"));
    }
    print("hash", file.hash);
    for (const std::string& note : file.notes)
        print("note", note);
    const std::vector<std::string> findings = file.report.lines();
    for (const std::string& finding : findings)
        print("defect", finding);
    if (is_inside_out(file.report))
        print("defect", inside_out_words);
    if (findings.empty())
        print("defects", "none");
}

} // namespace

std::function<int()> add_info(CLI::App& app) {
    const auto paths = std::make_shared<std::vector<std::string>>();
    app.add_option("MESH", *paths,
                   "Mesh files: " + mesh_format_names() + "; a series (.pvd); OpenSim models (.osim)");
    return [paths] {
        if (paths->empty())
            throw_error("info", "no mesh", "info MESH...", ErrorKind::usage);
        for (const std::string& path : *paths)
            print_file(path);
        return 0;
    };
}

} // namespace fascicle::app
