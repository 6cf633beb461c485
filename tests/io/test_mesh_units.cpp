// What files say of unit and frame: found, written, and taken into one scene.
#include "fascicle/base/error.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/load_scene.hpp"
#include "fascicle/io/mesh_file.hpp"
#include "fascicle/io/mesh_stamp.hpp"
#include "fascicle/io/mesh_units.hpp"
#include "support/shapes.hpp"
#include "support/temp_dir.hpp"

#include <catch2/catch.hpp>
#include <sstream>

using namespace fascicle;
using namespace fascicle::test;
using Catch::Matchers::Contains;

namespace {

MeshStamp stamp(double millimetres, MeshSpace space, char up) {
    MeshStamp s;
    s.hints = {space, millimetres};
    s.up = up;
    return s;
}

std::string vtp(const std::string& attributes, const std::string& field, const std::string& behind = {}) {
    return "<VTKFile type=\"PolyData\" " + attributes + "><PolyData>\n<FieldData>" + field +
           "</FieldData>\n<Piece NumberOfPoints=\"1\"><Points><DataArray type=\"Float64\" "
           "NumberOfComponents=\"3\" format=\"ascii\">1 2 3</DataArray></Points></Piece></PolyData>" +
           behind + "</VTKFile>\n";
}

UnitSource source(const char* name, double diagonal, std::optional<double> millimetres = {},
                  std::optional<MeshSpace> space = {}) {
    return {name, diagonal, {space, millimetres}, {}};
}

bool has(const std::vector<std::string>& notes, const std::string& words) {
    for (const std::string& note : notes)
        if (note.find(words) != std::string::npos)
            return true;
    return false;
}

} // namespace

TEST_CASE("3D Slicer's SPACE is found in the FieldData of VTP in every encoding", "[io][hints]") {
    // As VTK 9.1 writes a string array.
    const std::string start = "<Array type=\"String\" Name=\"SPACE\" NumberOfTuples=\"1\" format=";
    const auto space = [](const std::string& bytes) {
        CHECK(read_mesh_bytes(bytes, "slicer.vtp").mesh.vertex_count() == 1);
        return find_mesh_hints(bytes).space;
    };
    CHECK(space(vtp("", start + "\"ascii\">82 65 83 0</Array>")) == MeshSpace::ras);
    CHECK(space(vtp("", start + "\"ascii\">\n 76 80 83 0\n</Array>")) == MeshSpace::lps);
    CHECK(space(vtp("header_type=\"UInt32\"", start + "\"binary\">\nBAAAAFJBUwA=\n</Array>")) ==
          MeshSpace::ras);
    CHECK(space(vtp("header_type=\"UInt32\" compressor=\"vtkZLibDataCompressor\"",
                    start + "\"binary\">AQAAAACAAAAEAAAADAAAAA==eJwLcgxmAAACtQDn</Array>")) ==
          MeshSpace::ras);
    const std::string raw("\4\0\0\0LPS\0", 8);
    CHECK(space(vtp("header_type=\"UInt32\"", start + "\"appended\" offset=\"0\"/>",
                    "<AppendedData encoding=\"raw\">_" + raw + "</AppendedData>")) == MeshSpace::lps);
    CHECK(space(vtp("", start + "\"ascii\">82 65 0</Array>")) == std::nullopt);
    // What cannot be read says nothing; the reader of the mesh tells of it or passes it over.
    CHECK(find_mesh_hints(vtp("", start + "\"binary\">!!!!</Array>")) == MeshHints{});
    CHECK(find_mesh_hints(vtp("", start + "\"appended\" offset=\"9\"/>")) == MeshHints{});
    const TempDir folder;
    const auto file = folder.path() / "slicer.vtp";
    write_file(file,
               vtp("header_type=\"UInt32\"", start + "\"appended\" offset=\"0\"/>",
                   std::string(100000, ' ') + "<AppendedData encoding=\"raw\">_" + raw + "</AppendedData>"));
    CHECK(read_mesh_hints(file).space == MeshSpace::lps);
}

TEST_CASE("3D Slicer's SPACE is found in the fields of legacy VTK, text and binary", "[io][hints]") {
    const std::string head = "# vtk DataFile Version 5.1\nvtk output\nBINARY\nDATASET POLYDATA\n"
                             "FIELD FieldData 1\nSPACE 1 1 string\n";
    CHECK(find_mesh_hints(head + "\xC3RAS\nPOINTS 0 float\n").space == MeshSpace::ras);
    CHECK(find_mesh_hints(head + "LPS\n\nPOINTS 0 float\n").space == MeshSpace::lps);
    CHECK(find_mesh_hints(head + "XYZ\n\nPOINTS 0 float\n").space == std::nullopt);
}

TEST_CASE("Unit and frame of a mesh come back from every format that has a place for them", "[io][hints]") {
    MeshData data;
    data.mesh = sphere(50, 1);
    const MeshStamp wanted = stamp(25.4, MeshSpace::ras, 'y');
    for (const MeshFormat& format : mesh_formats()) {
        INFO(format.name);
        std::ostringstream out, plain;
        write_stamped(out, format, data, wanted);
        const std::string bytes = out.str(), name = "a" + format.extensions.front();
        const MeshFormat* found = nullptr;
        const MeshData back = read_mesh_data(bytes, name, &found);
        CHECK(found == &format);
        CHECK(back.mesh.triangles.size() == data.mesh.triangles.size());
        const MeshStamp got = find_mesh_stamp(bytes);
        const auto lost = lost_of_stamp(format, wanted);
        CHECK(got.up == 'y');
        if (format.extensions.front() == ".glb") {
            CHECK(got.hints == MeshHints{std::nullopt, 1000.0}); // metres, whatever was written
            CHECK(has(lost, "SPACE=RAS"));
        } else if (format.extensions.front() == ".usda") {
            CHECK(*got.hints.millimetres == Approx(25.4));
            CHECK(has(lost, "SPACE=RAS"));
        } else {
            CHECK(got.hints == wanted.hints);
            CHECK(got.up == wanted.up);
            CHECK(lost.empty());
        }
        format.write(plain, data);
        std::ostringstream nothing;
        write_stamped(nothing, format, data, {});
        CHECK(nothing.str() == plain.str());
    }
}

TEST_CASE("Files that state their unit are converted, those whose sizes disagree are an error",
          "[io][unit]") {
    const auto units = [](const std::vector<UnitSource>& files, double unstated,
                          std::optional<LengthUnit> wanted = {}) {
        return choose_units(files, unstated, wanted);
    };
    UnitChoice choice = units({source("femur.stl", 450), source("muscle.glb", 0.3, 1000)}, 450);
    CHECK(choice.unit == LengthUnit::millimetre);
    CHECK(choice.factors == std::vector<double>{1, 1000});
    CHECK(has(choice.notes, "unit guessed: millimetres (diagonal 450)"));
    CHECK(has(choice.notes, "muscle.glb: says metres, taken times 1000 to the scene's millimetres"));

    choice = units({source("a.obj", 45, 10), source("b.glb", 0.3, 1000)}, 0); // all stated: millimetres
    CHECK(choice.unit == LengthUnit::millimetre);
    CHECK(choice.factors == std::vector<double>{10, 1000});
    choice = units({source("b.glb", 0.3, 1000), source("c.glb", 0.4, 1000)}, 0);
    CHECK(choice.unit == LengthUnit::metre);
    CHECK(choice.factors == std::vector<double>{1, 1});
    CHECK(has(choice.notes, "unit: metres, as files say"));
    choice = units({source("b.glb", 0.3, 1000)}, 0, LengthUnit::millimetre);
    CHECK(choice.factors == std::vector<double>{1000});

    // Not believed: 412 m.
    choice = units({source("femur.stl", 450), source("mm.glb", 412, 1000)}, 500);
    CHECK(choice.factors == std::vector<double>{1, 1});
    CHECK(has(choice.notes, "mm.glb: says metres, which its size does not fit (diagonal 412)"));

    CHECK_THROWS_WITH(units({source("femur.stl", 0.45), source("muscle.stl", 300)}, 300),
                      Contains("femur.stl: seems to be in metres (diagonal 0.45), muscle.stl in millimetres "
                               "(diagonal 300)") &&
                          Contains("convert IN OUT --units mm"));
    choice = units({source("femur.stl", 0.45), source("muscle.stl", 300)}, 300, LengthUnit::millimetre);
    CHECK(choice.factors == std::vector<double>{1, 1});
    CHECK(has(choice.notes, "seems to be in metres"));
    // A sesamoid bone in millimetres is small, and no mistake; so is a toy scene.
    CHECK_NOTHROW(units({source("sesamoid.stl", 3), source("tibia.stl", 400)}, 400));
    CHECK_NOTHROW(units({source("a.stl", 1.5), source("b.stl", 6)}, 7));
    CHECK_NOTHROW(units({source("a.stl", 0), source("b.stl", 600)}, 600));
}

TEST_CASE("Frames that files state are noted when they are RAS or differ", "[io][unit]") {
    const auto lps = source("a", 1, {}, MeshSpace::lps), ras = source("b", 1, {}, MeshSpace::ras);
    CHECK(frame_notes({lps, source("c", 1)}).empty());
    CHECK(has(frame_notes({ras}), "the frame is RAS in b"));
    UnitSource up = source("d.glb", 1);
    up.up = 'y';
    CHECK(has(frame_notes({lps, up}), "y is up in d.glb, as the file says, which a do not say"));
    CHECK(has(frame_notes({lps, ras}), "frames differ: RAS in b, LPS in a"));
}

TEST_CASE("A scene of files in metres and millimetres fits together, or says which do not",
          "[io][load_scene]") {
    const TempDir folder;
    const auto path = [&](const char* name) { return folder.path() / name; };
    const auto write = [&](const char* name, TriMesh mesh, double scale, const MeshStamp& what) {
        for (Vec3& p : mesh.positions)
            p *= scale;
        MeshData data;
        data.mesh = std::move(mesh);
        write_stamped_file(path(name), data, what);
    };
    write("muscle.ply", sphere(30, 2, Vec3(80, 0, 0)), 1, {});
    write("bone.ply", sphere(40, 2), 0.001, stamp(1000, MeshSpace::lps, 'z'));
    write("silent.ply", sphere(40, 2), 0.001, {});
    write_file(path("fibres.obj"), "# 1 unit = 1000 mm\nv 0.06 0 0\nv 0.1 0 0\nl 1 2\n");
    write_file(path("far.obj"), "v 0.06 0 0\nv 0.1 0 0\nl 1 2\n");
    SceneRequest r;
    r.muscles = {path("muscle.ply")};
    r.bones = {path("bone.ply")};
    r.surface_fibres = {{"muscle", path("fibres.obj")}};
    const LoadedScene loaded = load_scene(r);
    CHECK(loaded.scene.unit == LengthUnit::millimetre);
    CHECK(loaded.scene.bones[0].mesh->positions[5].norm() == Approx(40));
    CHECK(loaded.scene.bones[0].source.hash.empty()); // no longer what the file holds
    CHECK_FALSE(loaded.scene.muscles[0].source.hash.empty());
    CHECK(loaded.scene.muscles[0].surface_fibres->points[1].isApprox(Vec3(100, 0, 0)));
    CHECK(has(loaded.notes, "bone.ply: says metres, taken times 1000"));
    CHECK(has(loaded.notes, "fibres.obj: says metres, taken times 1000"));

    r.surface_fibres = {{"muscle", path("far.obj")}};
    CHECK_THROWS_WITH(load_scene(r), Contains("far.obj") && Contains("--units mm"));
    r.surface_fibres.clear();
    r.bones = {path("silent.ply")};
    CHECK_THROWS_WITH(load_scene(r), Contains("silent.ply") && Contains("muscle.ply"));
}
