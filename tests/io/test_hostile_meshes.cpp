// Files made to harm, in every mesh format: read in a child process whose memory is limited. Each must end in a mesh or in an Error
// of one line.
#include "fascicle/base/error.hpp"
#include "fascicle/io/mesh_convert.hpp"
#include "fascicle/io/mesh_file.hpp"
#include "fascicle/io/series_file.hpp"
#include "io/formats/pvd.hpp"
#include "io/mesh_samples.hpp"
#include "support/shapes.hpp"

#include <bit>
#include <catch2/catch.hpp>
#include <chrono>
#include <fstream>
#include <iostream>
#include <random>
#include <sstream>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <zlib.h>

using namespace fascicle;
using namespace fascicle::test;
using Catch::Matchers::Contains;

namespace {

enum Outcome { mesh = 0, error = 1, no_memory = 2, bad_mesh = 3, bad_message = 4, other = 5 };

Outcome outcome(const std::string& bytes, const std::string& name) {
    try {
        const MeshFile file = read_mesh_bytes(bytes, name);
        bool good = check_mesh(file.mesh).usable();
        for (const auto& line : file.lines.lines)
            for (const int v : line)
                good = good && v >= 0 && static_cast<std::size_t>(v) < file.lines.points.size();
        for (const NamedArray& array : file.point_arrays)
            good = good &&
                   array.values.size() == static_cast<std::size_t>(array.components) *
                                              std::max(file.mesh.positions.size(), file.lines.points.size());
        return good ? mesh : bad_mesh;
    } catch (const Error& problem) {
        const std::string message = problem.what();
        return message.find('\n') == std::string::npos && message.find(name) != std::string::npos
                   ? error
                   : bad_message;
    } catch (const std::bad_alloc&) {
        return no_memory;
    } catch (...) {
        return other;
    }
}

/// What the address space may grow by: for a file of a few bytes, and for each byte of it. Sanitizers need all of it for themselves.
constexpr std::size_t base_bytes = std::size_t{96} << 20, per_byte = 40;

/// Runs in a child process with limited memory; the worst outcome of its files, or 100 and the signal that ended it.
template <typename Work>
int in_child(std::size_t largest_file, Work work) {
    std::cout.flush();
    const pid_t pid = ::fork();
    if (pid == 0) {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
        std::ifstream statm("/proc/self/statm");
        std::size_t pages = 0;
        statm >> pages;
        const rlim_t limit =
            pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)) + base_bytes + per_byte * largest_file;
        const rlimit bound{limit, limit};
        ::setrlimit(RLIMIT_AS, &bound);
#endif
        ::alarm(120);
        ::_exit(work());
    }
    int status = 0;
    REQUIRE(pid > 0);
    ::waitpid(pid, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 100 + WTERMSIG(status);
}

int in_child(const std::string& bytes, const std::string& name) {
    return in_child(bytes.size(), [&] { return outcome(bytes, name); });
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
    return text;
}

template <typename T>
std::string raw(T value) {
    return {reinterpret_cast<const char*>(&value), sizeof value};
}

/// Texts with @ where a count stands, or ~ where a coordinate does.
const std::vector<std::pair<std::string, std::string>>& templates() {
    static const std::string vtk = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\n";
    static const std::string vtk_points = "POINTS 3 float\n0 0 0 1 0 ~ 0 1 0\n";
    static const std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nelement face 1\nproperty list int int vertex_indices\nend_header\n"
        "0 0 0\n1 0 ~\n0 1 0\n3 0 1 2\n";
    static const std::string vtp =
        "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"3\" "
        "NumberOfPolys=\"1\"><Points><DataArray "
        "type=\"Float64\" NumberOfComponents=\"3\">0 0 0 1 0 ~ 0 1 0</DataArray></Points><Polys><DataArray "
        "type=\"Int64\" Name=\"connectivity\">0 1 2</DataArray><DataArray type=\"Int64\" "
        "Name=\"offsets\">3</DataArray></Polys></Piece></PolyData></VTKFile>";
    static const std::vector<std::pair<std::string, std::string>> rows{
        {"points.vtk", vtk + "POINTS @ float\n0 0 0\n"},
        {"cells.vtk", vtk + replaced(vtk_points, "~", "0") + "POLYGONS @ 4\n3 0 1 2\n"},
        {"size.vtk", vtk + replaced(vtk_points, "~", "0") + "POLYGONS 1 @\n3 0 1 2\n"},
        {"corners.vtk", vtk + replaced(vtk_points, "~", "0") + "POLYGONS 1 4\n@ 0 1 2\n"},
        {"index.vtk", vtk + replaced(vtk_points, "~", "0") + "POLYGONS 1 4\n3 0 1 @\n"},
        {"offset.vtk", vtk + replaced(vtk_points, "~", "0") +
                           "POLYGONS 2 3\nOFFSETS vtktypeint64\n0 @\nCONNECTIVITY vtktypeint64\n0 1 2\n"},
        {"coordinate.vtk", vtk + vtk_points + "POLYGONS 1 4\n3 0 1 2\n"},
        {"points.vtp", replaced(replaced(vtp, "~", "0"), "NumberOfPoints=\"3\"", "NumberOfPoints=\"@\"")},
        {"cells.vtp", replaced(replaced(vtp, "~", "0"), "NumberOfPolys=\"1\"", "NumberOfPolys=\"@\"")},
        {"components.vtp",
         replaced(replaced(vtp, "~", "0"), "NumberOfComponents=\"3\"", "NumberOfComponents=\"@\"")},
        {"index.vtp", replaced(replaced(vtp, "~", "0"), ">0 1 2<", ">0 1 @<")},
        {"offset.vtp", replaced(replaced(vtp, "~", "0"), ">3<", ">@<")},
        {"coordinate.vtp", vtp},
        {"vertices.ply", replaced(replaced(ply, "~", "0"), "vertex 3", "vertex @")},
        {"faces.ply", replaced(replaced(ply, "~", "0"), "face 1", "face @")},
        {"corners.ply", replaced(replaced(ply, "~", "0"), "3 0 1 2", "@ 0 1 2")},
        {"index.ply", replaced(replaced(ply, "~", "0"), "3 0 1 2", "3 0 1 @")},
        {"other.ply",
         replaced(replaced(ply, "~", "0"), "element face", "element other @\nproperty int a\nelement face")},
        {"coordinate.ply", ply},
        {"vertices.off", "OFF\n@ 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
        {"faces.off", "OFF\n3 @ 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
        {"corners.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n@ 0 1 2\n"},
        {"index.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 @\n"},
        {"coordinate.off", "OFF\n3 1 0\n0 0 0\n1 0 ~\n0 1 0\n3 0 1 2\n"},
        {"index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 @\n"},
        {"line.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2 @\n"},
        {"coordinate.obj", "v 0 0 0\nv 1 0 ~\nv 0 1 0\nf 1 2 3\n"},
        {"coordinate.stl",
         "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 ~\nvertex 0 1 0\nendloop\n"
         "endfacet\nendsolid\n"},
    };
    return rows;
}

std::string repeated(const std::string& text, int times) {
    std::string out;
    out.reserve(text.size() * static_cast<std::size_t>(times));
    for (int i = 0; i < times; ++i)
        out += text;
    return out;
}

/// A file of a million points at one place and a thousand triangles over them; of STL, which has corners alone, of triangles of
/// three equal corners.
std::string coincident(const std::string& extension) {
    const int points = 1000000;
    std::string triangles;
    for (int i = 0; i < 1000; ++i) {
        const int first = extension == ".obj" ? i + 1 : i;
        triangles += (extension == ".obj"   ? "f "
                      : extension == ".vtp" ? ""
                                            : "3 ") +
                     std::to_string(first) + ' ' + std::to_string(first + 1) + ' ' +
                     std::to_string(first + 7) + '\n';
    }
    const std::string n = std::to_string(points), cloud = repeated("1 2 3\n", points);
    if (extension == ".vtk")
        return "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS " + n + " float\n" + cloud +
               "POLYGONS 1000 4000\n" + triangles;
    if (extension == ".vtp") {
        std::string offsets;
        for (int i = 1; i <= 1000; ++i)
            offsets += std::to_string(3 * i) + ' ';
        return "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"" + n +
               "\" NumberOfPolys=\"1000\"><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\">" +
               cloud + "</DataArray></Points><Polys><DataArray type=\"Int32\" Name=\"connectivity\">" +
               triangles + "</DataArray><DataArray type=\"Int32\" Name=\"offsets\">" + offsets +
               "</DataArray></Polys></Piece></PolyData></VTKFile>";
    }
    if (extension == ".ply")
        return "ply\nformat ascii 1.0\nelement vertex " + n +
               "\nproperty float x\nproperty float y\nproperty float z\nelement face 1000\nproperty list "
               "uchar int "
               "vertex_indices\nend_header\n" +
               cloud + triangles;
    if (extension == ".off")
        return "OFF\n" + n + " 1000 0\n" + cloud + triangles;
    if (extension == ".obj")
        return repeated("v 1 2 3\n", points) + triangles;
    if (extension != ".stl") {
        MeshData data;
        data.mesh.positions.assign(static_cast<std::size_t>(points), Vec3(1, 2, 3));
        for (int i = 0; i < 1000; ++i)
            data.mesh.triangles.push_back({i, i + 1, i + 7});
        return written(format_for_writing("a" + extension), data);
    }
    const std::string corner = raw(1.0f) + raw(2.0f) + raw(3.0f);
    return std::string(80, ' ') + raw<std::uint32_t>(333334) +
           repeated(std::string(12, '\0') + corner + corner + corner + "ab", 333334);
}

} // namespace

TEST_CASE("hostile meshes: cut off at every hundredth, in every format", "[io][hostile]") {
    MeshData data;
    data.mesh = sphere(50, 3);
    data.point_arrays = {{"depth", 1, std::vector<double>(data.mesh.positions.size(), 0.25)}};
    auto files = mesh_samples();
    for (const MeshFormat& format : mesh_formats())
        files.emplace_back("sphere" + format.extensions[0], written(format, data));
    for (const auto& [name, bytes] : files) {
        INFO(name);
        const int worst = in_child(bytes.size(), [&, &file = bytes, &called = name] {
            int out = 0;
            for (std::size_t percent = 0; percent < 100; ++percent)
                out = std::max<int>(out, outcome(file.substr(0, file.size() * percent / 100), called));
            return out;
        });
        CHECK(worst == error);
    }
}

TEST_CASE("hostile meshes: flipped bits, in every format", "[io][hostile]") {
    for (const auto& [name, bytes] : mesh_samples()) {
        INFO(name);
        const int worst = in_child(bytes.size(), [&, &file = bytes, &called = name] {
            std::mt19937 random(7);
            int out = 0;
            for (int round = 0; round < 400; ++round) {
                std::string damaged = file;
                for (int flips = 1 + round % 3; flips > 0; --flips) {
                    char& c = damaged[random() % damaged.size()];
                    c = static_cast<char>(c ^ (1 << (random() % 8)));
                }
                out = std::max<int>(out, outcome(damaged, called));
            }
            return out;
        });
        CHECK(worst <= error);
    }
}

TEST_CASE("hostile meshes: counts and indices that no file has", "[io][hostile]") {
    for (const auto& [name, text] : templates()) {
        if (text.find('@') == std::string::npos)
            continue;
        INFO(name);
        for (const char* count : {"2147483647", "2147483648", "4294967295", "9223372036854775807",
                                  "9223372036854775808", "18446744073709551615", "-1", "-2147483648",
                                  "-9223372036854775808", "268435455", "1e9", "nan", ""}) {
            INFO(count);
            const int result = in_child(replaced(text, "@", count), name);
            // A count that is missing can make the next number one, and OBJ counts back from -1: these may be meshes.
            const bool may_be_good =
                *count == '\0' || (name.find(".obj") != std::string::npos && count == std::string("-1"));
            CHECK((may_be_good ? result <= error : result == error));
        }
    }
    // Binary ones: 2^31 and 2^32 - 1 triangles of STL, lists and counts of PLY, lengths of legacy VTK.
    for (const std::uint32_t count : {0x7fffffffu, 0x80000000u, 0xffffffffu}) {
        INFO(count);
        const std::string stl = std::string(80, ' ') + raw(count) + std::string(100, '\0');
        CHECK(in_child(stl, "many.stl") == error);
        const std::string ply =
            "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty char x\nproperty char "
            "y\nproperty char z\nelement face 1\nproperty list uint uchar vertex_indices\nend_header\n";
        CHECK(in_child(ply + std::string(3, '\0') + raw(count) + std::string(100, '\0'), "list.ply") ==
              error);
        const std::string vtk = "# vtk DataFile Version 3.0\nt\nBINARY\nDATASET POLYDATA\nPOINTS 1 float\n" +
                                std::string(12, '\0') + "\nPOLYGONS 1 4\n";
        CHECK(in_child(vtk + raw(count) + std::string(100, '\0'), "cell.vtk") == error);
    }
}

TEST_CASE("hostile meshes: coordinates that are none, and huge ones", "[io][hostile]") {
    for (const auto& [name, text] : templates()) {
        if (text.find('~') == std::string::npos)
            continue;
        for (const char* value : {"nan", "inf", "-inf", "NAN", "1e999", "1,5", "0x10"}) {
            INFO(name << ' ' << value);
            CHECK(in_child(replaced(text, "~", value), name) == error);
        }
        for (const char* value : {"1e38", "-3.4e38", "1e-320", "1.7976931348623157e308"}) {
            INFO(name << ' ' << value);
            CHECK(in_child(replaced(text, "~", value), name) == mesh);
        }
    }
    for (const float value :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1e38f}) {
        const std::string one = raw(0.0f) + raw(1.0f) + raw(value);
        const std::string stl =
            std::string(80, ' ') + raw<std::uint32_t>(1) + std::string(12, '\0') + one + one + one + "ab";
        CHECK(in_child(stl, "a.stl") == (std::isfinite(value) ? mesh : error));
    }
}

TEST_CASE("hostile meshes: a million points at one place", "[io][hostile][slow]") {
    for (const MeshFormat& format : mesh_formats()) {
        INFO(format.name);
        const std::string file = coincident(format.extensions[0]);
        const auto start = std::chrono::steady_clock::now();
        CHECK(in_child(file, "a" + format.extensions[0]) == mesh);
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
        CHECK(took.count() < 60); // a second, in a plain build
    }
}

TEST_CASE("hostile meshes: nothing, and nothing but noise", "[io][hostile]") {
    std::mt19937 random(11);
    std::string noise(20000, '\0');
    for (char& c : noise)
        c = static_cast<char>(random());
    for (const MeshFormat& format : mesh_formats()) {
        const std::string name = "a" + format.extensions[0];
        INFO(name);
        CHECK(in_child("", name) == error);
        CHECK(in_child(" \n\t\r\n ", name) == error);
        CHECK(in_child("\xef\xbb\xbf", name) == error);
        CHECK(in_child(noise, name) == error);
        CHECK(in_child(std::string(20000, '\0'), name) == error);
        CHECK(in_child(std::string(20000, '9'), name) == error);
    }
}

TEST_CASE("hostile meshes: compressed zeros stay within the limit of numbers, and the memory with them",
          "[io][hostile]") {
    // 4 kB that inflate to 4 MB of bytes, each a number of 8 bytes: just within the limit; then three of them: beyond.
    const std::string zeros(4000000, '\0');
    uLongf size = compressBound(static_cast<uLong>(zeros.size()));
    std::string packed(size, '\0');
    REQUIRE(compress(reinterpret_cast<Bytef*>(packed.data()), &size,
                     reinterpret_cast<const Bytef*>(zeros.data()), static_cast<uLong>(zeros.size())) == Z_OK);
    const std::string data = raw<std::uint32_t>(1) + raw<std::uint32_t>(4000000) + raw<std::uint32_t>(0) +
                             raw(static_cast<std::uint32_t>(size)) + packed.substr(0, size);
    for (const int arrays : {1, 3}) {
        const std::string file =
            "<VTKFile type=\"PolyData\" compressor=\"vtkZLibDataCompressor\"><PolyData><Piece "
            "NumberOfPoints=\"4000000\"><PointData>" +
            repeated("<DataArray Name=\"a\" type=\"Int8\" format=\"appended\" offset=\"0\"/>", arrays) +
            "</PointData></Piece></PolyData><AppendedData encoding=\"raw\">_" + data +
            "</AppendedData></VTKFile>";
        REQUIRE(file.size() < 5000);
        CHECK(in_child(file, "zeros.vtp") == error);
        CHECK_THROWS_WITH(
            read_mesh_bytes(file, "zeros.vtp"),
            Contains(arrays == 1 ? "a piece without <Points>" : "than a file of this size is trusted with"));
    }
}

TEST_CASE("hostile XML: deep nesting, entities, endless names", "[io][hostile]") {
    const std::string head = "<VTKFile type=\"PolyData\"><PolyData>",
                      series = "<VTKFile type=\"Collection\"><Collection>";
    std::string deep, laughs = "<?xml version=\"1.0\"?><!DOCTYPE lolz [<!ENTITY lol \"lol\">";
    for (int i = 0; i < 200000; ++i)
        deep += "<a>";
    for (int i = 1; i < 10; ++i) {
        const std::string before = i == 1 ? "lol" : "lol" + std::to_string(i - 1);
        laughs += "<!ENTITY lol" + std::to_string(i) + " \"";
        for (int k = 0; k < 10; ++k)
            laughs += "&" + before + ";";
        laughs += "\">";
    }
    laughs += "]>";
    const std::string attributes = [] {
        std::string text = "<a ";
        for (int i = 0; i < 100000; ++i)
            text += "k" + std::to_string(i) + "=\"\" ";
        return text + "/>";
    }();
    const auto series_outcome = [](const std::string& text) {
        return in_child(text.size(), [&] {
            try {
                parse_series(text, "a.pvd");
                return mesh;
            } catch (const Error& problem) {
                return std::string(problem.what()).find("a.pvd, line") == 0 ? error : bad_message;
            } catch (...) {
                return other;
            }
        });
    };
    for (const std::string& bad :
         {deep, laughs + "<VTKFile>&lol9;</VTKFile>", attributes, "<" + std::string(1000000, 'a'),
          std::string("<a b=\""), std::string("<!--"), std::string("<?"), std::string("<![CDATA[")}) {
        INFO(bad.substr(0, 60));
        CHECK(in_child(head + bad, "a.vtp") == error);
        CHECK(in_child(bad + head, "a.vtp") == error);
        CHECK(series_outcome(series + bad) == error);
        CHECK(series_outcome(bad + series) == error);
    }
    CHECK_THROWS_WITH(io::read_pvd(laughs, "a.pvd"), Contains("a document type, entities"));
    // An entity that nobody declared stands for itself; the five of XML are read.
    const auto named =
        io::read_pvd(series + "<DataSet file=\"&lol;&amp;&lt;\"/></Collection></VTKFile>", "a.pvd");
    REQUIRE(named.size() == 1);
    CHECK(named[0].second == "&lol;&<");
}

TEST_CASE("a series of files is read back as it was written, and damaged ones end in an error",
          "[io][hostile]") {
    const std::vector<std::pair<double, std::string>> steps{
        {0, "frames/a & b.0000.vtp"}, {1.0 / 3, "frames/\"größer\".0001.vtp"}, {1e9, "../x.vtp"}};
    std::ostringstream out;
    io::write_pvd(out, steps);
    CHECK(io::looks_like_pvd(out.str()));
    CHECK(io::read_pvd(out.str(), "a.pvd") == steps);
    for (std::size_t n = 0; n + 1 < out.str().size(); ++n) // without the last line end it is whole
        CHECK_THROWS_AS(io::read_pvd(out.str().substr(0, n), "a.pvd"), Error);
    const auto fails = [](const std::string& text, const std::string& words) {
        CHECK_THROWS_WITH(io::read_pvd(text, "a.pvd"), Contains("a.pvd, line") && Contains(words));
    };
    fails("", "not a series");
    fails("<VTKFile type=\"PolyData\"/>", "not a series");
    fails("<VTKFile type=\"Collection\"><Collection><DataSet timestep=\"x\" file=\"a\"/>", "timestep is 'x'");
    fails("<VTKFile type=\"Collection\"><Collection><DataSet timestep=\"nan\" file=\"a\"/>",
          "timestep is 'nan'");
    fails("<VTKFile type=\"Collection\"><Collection><DataSet timestep=\"1\"/>", "a step without a file");
}
