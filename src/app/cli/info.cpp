// fascicle info MESH...: what a mesh file holds and what is wrong with it.

#include "app/cli/command.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/base/param_table.hpp"
#include "fascicle/base/text.hpp"
#include "fascicle/geometry/bounding_box.hpp"
#include "fascicle/geometry/volume.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/format_registry.hpp"
#include "fascicle/io/load_scene.hpp"
#include "fascicle/io/mesh_file.hpp"
#include "fascicle/io/mesh_hints.hpp"
#include "fascicle/io/osim_request.hpp"
#include "fascicle/io/series_file.hpp"
#include "fascicle/io/unit_guess.hpp"

#include <CLI/CLI.hpp>
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
    print("area", text(surface_area(mesh.positions, mesh.triangles)) + ' ' + unit + "2");
    print("volume", report.closed() ? text(signed_volume(mesh.positions, mesh.triangles)) + ' ' + unit + '3'
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
void print_hints(const MeshHints& hints) {
    if (hints.millimetres)
        print("file's unit", "1 unit = " + number_text(*hints.millimetres) + " mm");
    if (hints.space)
        print("file's frame", *hints.space == MeshSpace::ras ? "RAS (+x right, +y anterior, +z superior)"
                                                             : "LPS (+x left, +y posterior, +z superior)");
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
    const UnitGuess guess = guess_length_unit(box.diagonal());
    const std::string unit = to_text(guess.unit);
    if (!box.empty())
        print("unit",
              unit + " (guessed from the size" + (guess.sure ? ")" : ", which fits neither m nor mm)"));
    print_hints(find_mesh_hints(bytes));
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
        print("size", text(box.size()) + ", diagonal " + text(box.diagonal()));
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
