#include "fascicle/base/error.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/format_registry.hpp"
#include "fascicle/io/mesh_convert.hpp"
#include "fascicle/io/mesh_file.hpp"
#include "io/mesh_samples.hpp"
#include "support/shapes.hpp"
#include "support/temp_dir.hpp"

#include <catch2/catch.hpp>
#include <clocale>
#include <fstream>
#include <map>

using namespace fascicle;
using namespace fascicle::test;
using Catch::Matchers::Contains;

namespace {

Points as_floats(Points points) {
    for (Vec3& p : points)
        p = p.cast<float>().cast<double>();
    return points;
}

} // namespace

TEST_CASE("every format that writes reads its own files, with Umlauts in the path", "[io][mesh_file]") {
    const TempDir dir;
    for (const MeshFormat& format : mesh_formats()) {
        INFO(format.name);
        MeshData data;
        data.mesh = sphere(2.5, 2, Vec3(0.1, 0.2, 0.3));
        if (!format.holds.doubles) // and the order of vertices
            data.mesh = as_stl_has_it(data.mesh);
        CHECK(fit_to_format(data, format).empty());
        const auto path = dir.path() / ("Hüfte größer " + format.name + format.extensions[0]);
        write_mesh_file(path, data);
        const MeshFile file = read_mesh_file(path);
        CHECK(file.format == format.name);
        if (format.holds.doubles)
            CHECK(file.mesh.positions == data.mesh.positions);
        else // as text a float has a few digits: the same as a float
            CHECK(as_floats(file.mesh.positions) == as_floats(data.mesh.positions));
        CHECK(file.mesh.triangles == data.mesh.triangles);
        CHECK(file.report.closed());
        CHECK(file.hash.size() == 16);
    }
}

TEST_CASE("content tells the format where the extension lies, behind a byte order mark, with other line ends",
          "[io][mesh_file]") {
    const TempDir dir;
    for (const auto& [name, bytes] : mesh_samples()) {
        const MeshFile honest = read_mesh_bytes(bytes, name);
        for (const MeshFormat& other : mesh_formats())
            for (const std::string& extension : {other.extensions[0], std::string(".dat"), std::string()}) {
                INFO(name << " as " << extension);
                const MeshFile file = read_mesh_bytes(bytes, "lying" + extension);
                CHECK(file.format == honest.format);
                CHECK(file.mesh.positions == honest.mesh.positions);
                CHECK(file.mesh.triangles == honest.mesh.triangles);
            }
        INFO(name);
        write_file(dir.path() / "file.dat", bytes);
        REQUIRE(recognise_file(dir.path() / "file.dat") != nullptr);
        CHECK(recognise_file(dir.path() / "file.dat")->name == honest.format);
        const bool binary = std::any_of(bytes.begin(), bytes.end(),
                                        [](char c) { return static_cast<signed char>(c) < '\t'; });
        if (binary)
            continue;
        CHECK(read_mesh_bytes("\xef\xbb\xbf" + bytes, "a.dat").mesh.triangles == honest.mesh.triangles);
        if (name.find(".obj") == std::string::npos) // a tab before # is no comment's business there
            CHECK(read_mesh_bytes(" \n\t" + bytes, "a.dat").mesh.triangles == honest.mesh.triangles);
        std::string crlf;
        for (const char c : bytes)
            crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
        CHECK(read_mesh_bytes(crlf, "a.dat").mesh.triangles == honest.mesh.triangles);
    }
    CHECK(recognise_file(dir.path() / "none") == nullptr);
    CHECK(recognise_file(dir.path()) == nullptr);
    // Of a large binary STL only the size tells, not its beginning.
    MeshData large;
    large.mesh = sphere(1, 5);
    write_mesh_file(dir.path() / "large.stl", large);
    std::filesystem::rename(dir.path() / "large.stl", dir.path() / "large.dat");
    REQUIRE(std::filesystem::file_size(dir.path() / "large.dat") > (std::size_t{1} << 16));
    REQUIRE(recognise_file(dir.path() / "large.dat") != nullptr);
    CHECK(recognise_file(dir.path() / "large.dat")->name == "STL");
}

TEST_CASE("what a format cannot hold is dropped and said", "[io][mesh_file]") {
    MeshData all;
    all.mesh = box(1.1, 2, 3);
    all.lines = {all.mesh.positions, {{0, 1, 2}, {3, 4}}};
    all.point_arrays = {{"depth", 1, std::vector<double>(8, 0.5)}, {"RGB", 3, std::vector<double>(24, 200)}};
    all.line_arrays = {{"fibre_id", 1, {0, 1}}};
    const std::string array_of_lines = "arrays of lines, which NAME cannot hold here: fibre_id";
    const std::map<std::string, std::vector<std::string>> expected{
        {"VTK legacy", {array_of_lines}},
        {"VTK XML", {array_of_lines}},
        {"PLY", {"lines are written as edges of two points", array_of_lines}},
        {"OBJ", {"arrays of points, which OBJ cannot hold here: depth, RGB", array_of_lines}},
        {"glTF 2.0", {"cannot hold here: depth, RGB", array_of_lines, "rounded to float"}},
        {"USD text", {"cannot hold here: depth, RGB", array_of_lines, "rounded to float"}},
        {"OFF", {"2 lines, which OFF cannot hold", "cannot hold here: depth", array_of_lines}},
        {"STL",
         {"2 lines", "depth, RGB", array_of_lines, "the 8 vertices come back in the order",
          "rounded to float"}}};
    REQUIRE(expected.size() == mesh_formats().size());
    for (const MeshFormat& format : mesh_formats()) {
        MeshData data = all;
        const std::vector<std::string> notes = fit_to_format(data, format);
        const std::vector<std::string>& words = expected.at(format.name);
        INFO(format.name);
        REQUIRE(notes.size() == words.size());
        for (std::size_t i = 0; i < words.size(); ++i) {
            std::string wanted = words[i];
            if (const std::size_t at = wanted.find("NAME"); at != std::string::npos)
                wanted.replace(at, 4, format.name);
            CHECK_THAT(notes[i], Contains(wanted));
        }
        // What is left comes back.
        const MeshData again = format.read(written(format, data), "a");
        CHECK(again.mesh.triangles.size() == 12);
        CHECK(again.lines.lines.size() == (!format.holds.lines ? 0u : format.holds.long_lines ? 2u : 3u));
        REQUIRE(again.point_arrays.size() == data.point_arrays.size());
        for (std::size_t i = 0; i < again.point_arrays.size(); ++i)
            CHECK(again.point_arrays[i].values == data.point_arrays[i].values);
    }
}

TEST_CASE("numbers do not depend on the locale", "[io][mesh_file]") {
    // In an image without German locales this runs in the C locale; the readers never ask the locale anyway.
    const char* found = nullptr;
    for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "de_DE", "fr_FR.UTF-8"})
        if (found == nullptr)
            found = std::setlocale(LC_ALL, name);
    const MeshFile file = read_mesh_bytes("v 0.5 1.5 2.5\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "a.obj");
    std::setlocale(LC_ALL, "C");
    CHECK(file.mesh.positions[0] == Vec3(0.5, 1.5, 2.5));
}

TEST_CASE("a byte order mark is passed over", "[io][mesh_file]") {
    CHECK(
        read_mesh_bytes("\xef\xbb\xbfv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "a.obj").mesh.triangle_count() ==
        1);
}

TEST_CASE("what cannot be read is said in one line", "[io][mesh_file]") {
    const TempDir dir;
    CHECK_THROWS_WITH(read_mesh_file(dir.path() / "none.obj"),
                      Contains("none.obj") && Contains("no such file"));
    CHECK_THROWS_WITH(read_mesh_file(dir.path()), Contains("is a folder"));
    CHECK_THROWS_WITH(read_mesh_bytes("", "x.bin"), Contains("the file is empty"));
    CHECK_THROWS_WITH(read_mesh_bytes("", "x.obj"), Contains("no points"));
    CHECK_THROWS_WITH(read_mesh_bytes("hello", "x.bin"), Contains("no known format; expected VTK legacy"));
    CHECK_THROWS_WITH(read_mesh_bytes("hello", "x.vtk"), Contains("x.vtk, line 1"));
    CHECK_THROWS_WITH(read_mesh_bytes("solid x\nendsolid\n", "x.obj"), // STL, whatever it is called
                      Contains("x.obj") && Contains("no points"));
}

TEST_CASE("what cannot be written is said in one line and leaves nothing behind", "[io][mesh_file]") {
    const TempDir dir;
    MeshData data;
    data.mesh = box();
    CHECK_THROWS_WITH(write_mesh_file(dir.path() / "a.xyz", data), Contains("'.xyz'") && Contains(".vtk"));
    CHECK_THROWS_AS(write_mesh_file("/dev/full/a.obj", data), Error);
    write_file(dir.path() / "file", "x");
    CHECK_THROWS_AS(write_mesh_file(dir.path() / "file" / "a.obj", data), Error);
    std::filesystem::create_directories(dir.path() / "folder.obj");
    CHECK_THROWS_WITH(write_mesh_file(dir.path() / "folder.obj", data), Contains("folder.obj"));
    std::size_t left = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(dir.path()))
        ++left;
    CHECK(left == 2);
}

TEST_CASE("harmless faults are mended on reading, and reported", "[io][mesh_file]") {
    const MeshFile file = read_mesh_bytes("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 9 9 9\n"
                                          "f 1 3 2\nf 1 2 4\nf 1 3 4\nf 2 3 4\nf 1 1 2\nf 1 3 2\n",
                                          "t.obj");
    CHECK(file.report.closed());
    CHECK(file.report.inconsistent_triangles == 1);
    CHECK(file.report.degenerate_triangles == 1);
    CHECK(file.report.duplicate_triangles == 1);
    CHECK(file.report.unused_vertices == 1);
    CHECK(file.mesh.vertex_count() == 5);
}
