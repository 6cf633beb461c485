// fascicle info MESH...: what a mesh file holds and what is wrong with it.

#include "app/cli/command.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/geometry/bounding_box.hpp"
#include "fascicle/geometry/volume.hpp"
#include "fascicle/io/load_scene.hpp"
#include "fascicle/io/mesh_file.hpp"
#include "fascicle/io/mesh_hints.hpp"
#include "fascicle/io/osim_request.hpp"
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
    std::cout << "  " << std::left << std::setw(14) << label << value << '\n';
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

/// What the header says of unit and axes: told, never acted on.
void print_hints(const std::string& path) {
    const MeshHints hints = read_mesh_hints(path);
    if (hints.millimetres)
        print("header", "1 unit = " + text(*hints.millimetres) + " mm");
    if (hints.space)
        print("axes", *hints.space == MeshSpace::ras ? "RAS (the header says so): x right, y anterior"
                                                     : "LPS (the header says so)");
}

/// What of an OpenSim model a scene can be made of.
void print_model(const std::string& path) {
    const OsimPreview model = preview_osim(path, {});
    std::cout << path << '\n';
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
    const MeshFile file = read_mesh_file(path);
    BoundingBox box = bounding_box(file.mesh.positions, file.mesh.triangles);
    for (const Vec3& p : file.lines.points)
        box.add(p);
    std::cout << path << '\n';
    print("format", file.format);
    const UnitGuess guess = guess_length_unit(box.diagonal());
    const std::string unit = to_text(guess.unit);
    if (!box.empty())
        print("unit",
              unit + " (guessed from the size" + (guess.sure ? ")" : ", which fits neither m nor mm)"));
    print_hints(path);
    if (!file.mesh.triangles.empty())
        print_surface(file, unit);
    if (!file.lines.lines.empty())
        print("polylines", std::to_string(file.lines.lines.size()));
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
    app.add_option("MESH", *paths, "Mesh files: OBJ, legacy VTK, VTP; OpenSim models");
    return [paths] {
        if (paths->empty())
            throw_error("info", "no mesh", "info MESH...", ErrorKind::usage);
        for (const std::string& path : *paths)
            print_file(path);
        return 0;
    };
}

} // namespace fascicle::app
