#include "fascicle/base/error.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/format_registry.hpp"
#include "fascicle/io/mesh_file.hpp"
#include "support/shapes.hpp"
#include "support/temp_dir.hpp"

#include <catch2/catch.hpp>
#include <clocale>
#include <fstream>

using namespace fascicle;
using namespace fascicle::test;
using Catch::Matchers::Contains;

TEST_CASE("every format that writes reads its own files, with Umlauts in the path", "[io][mesh_file]") {
    const TempDir dir;
    MeshData data;
    data.mesh = sphere(2.5, 2, Vec3(0.1, 0.2, 0.3));
    for (const MeshFormat& format : mesh_formats()) {
        const auto path = dir.path() / ("Hüfte größer " + format.name + format.extensions[0]);
        write_mesh_file(path, data);
        const MeshFile file = read_mesh_file(path);
        CHECK(file.format == format.name);
        CHECK(file.mesh.positions == data.mesh.positions);
        CHECK(file.mesh.triangles == data.mesh.triangles);
        CHECK(file.report.closed());
        CHECK(file.hash.size() == 16);
        // Content counts, not the name.
        const auto lying = dir.path() / "lying.stl";
        std::filesystem::copy_file(path, lying, std::filesystem::copy_options::overwrite_existing);
        CHECK(read_mesh_file(lying).format == format.name);
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
    CHECK_THROWS_WITH(read_mesh_bytes("solid x\nendsolid\n", "x.obj"),
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
