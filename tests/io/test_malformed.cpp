// Damaged files of every format: each must end in a mesh or in an Error, quickly.
#include "fascicle/base/error.hpp"
#include "fascicle/io/format_registry.hpp"
#include "fascicle/io/mesh_file.hpp"
#include "support/shapes.hpp"

#include <bit>
#include <catch2/catch.hpp>
#include <random>
#include <sstream>

using namespace fascicle;
using namespace fascicle::test;

namespace {

std::vector<std::pair<std::string, std::string>> samples() {
    MeshData data;
    data.mesh = box(1, 2, 3);
    data.lines = {data.mesh.positions, {{0, 1, 2}, {3, 4}}};
    std::vector<std::pair<std::string, std::string>> out;
    for (const MeshFormat& format : mesh_formats()) {
        std::ostringstream text;
        format.write(text, data);
        out.emplace_back("own" + format.extensions[0], text.str());
    }
    out.emplace_back(
        "rich.vtk",
        "# vtk DataFile Version 5.1\nt\nASCII\nDATASET POLYDATA\nPOINTS 4 float\n0 0 0 1 0 0 1 1 0 0 1 0\n"
        "METADATA\nINFORMATION 1\nNAME a LOCATION b\nDATA 1\n\nPOLYGONS 3 7\nOFFSETS vtktypeint64\n0 4 7\n"
        "CONNECTIVITY vtktypeint64\n0 1 2 3 0 1 2\nTRIANGLE_STRIPS 1 5\n4 0 1 3 2\nCELL_DATA 3\n"
        "SCALARS s float 1\nLOOKUP_TABLE default\n1 2 3\nFIELD f 1\nx 2 3 int\n1 2 3 4 5 6\nPOINT_DATA 4\n"
        "VECTORS v double\n1 2 3 1 2 3 1 2 3 1 2 3\n");
    std::string binary = "# vtk DataFile Version 3.0\nt\nBINARY\nDATASET POLYDATA\nPOINTS 3 float\n";
    binary += std::string(36, '\0') + "\nPOLYGONS 1 4\n";
    binary +=
        std::string("\0\0\0\3\0\0\0\0\0\0\0\1\0\0\0\2", 16) + "\nCELL_DATA 1\nFIELD f 2\na 1 1 string\n";
    binary += std::string("\xc2hi", 3) +
              "\nb 1 1 double\n12345678\nPOINT_DATA 3\nSCALARS s bit\nLOOKUP_TABLE d\nx\n";
    out.emplace_back("rich_binary.vtk", binary);
    out.emplace_back("rich.obj",
                     "mtllib a\nv 0 0 0 1 1 1\nv 1 0 0\nvt 0 0\nvn 0 0 1\nv 0 1 0\nv 1 1 0\nusemtl b\n"
                     "f 1/1/1 2//1 3/1 \\\n -1\ng x y\nl 1 2 -1\ns 1\nf -4 -3 -2\n");
    out.emplace_back(
        "rich.vtp",
        "<?xml version=\"1.0\"?><VTKFile type=\"PolyData\" byte_order=\"LittleEndian\"><PolyData><Piece "
        "NumberOfPoints=\"3\" NumberOfLines=\"1\" NumberOfPolys=\"1\"><PointData><DataArray Name=\"d\" "
        "type=\"Float32\" "
        "format=\"binary\">DAAAAAAAgD8AAIA/AACAPw==</DataArray></PointData><Points><DataArray "
        "type=\"Float32\" NumberOfComponents=\"3\" format=\"binary\">"
        "JAAAAAAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAA==</DataArray></Points><Lines><DataArray "
        "Name=\"connectivity\" type=\"Int64\">0 1 2</DataArray><DataArray type=\"Int8\" Name=\"offsets\">3"
        "</DataArray></Lines><Polys><DataArray type=\"Int32\" Name=\"connectivity\">0 1 2</DataArray>"
        "<DataArray type=\"Int32\" Name=\"offsets\">3</DataArray></Polys></Piece></PolyData></VTKFile>");
    return out;
}

/// A mesh whose indices are in range and whose coordinates are finite, or an Error of one line. True for a
/// mesh.
bool survives(const std::string& bytes, const std::string& name) {
    try {
        const MeshFile file = read_mesh_bytes(bytes, name);
        const MeshReport again = check_mesh(file.mesh);
        REQUIRE(again.usable());
        for (const auto& line : file.lines.lines)
            for (const int v : line)
                REQUIRE((v >= 0 && static_cast<std::size_t>(v) < file.lines.points.size()));
        return true;
    } catch (const Error& error) {
        const std::string message = error.what();
        REQUIRE(message.find('\n') == std::string::npos);
        REQUIRE(message.find(name) != std::string::npos);
        return false;
    }
}

} // namespace

TEST_CASE("the samples themselves are good", "[io][malformed]") {
    for (const auto& [name, bytes] : samples()) {
        INFO(name);
        CHECK(survives(bytes, name));
    }
}

TEST_CASE("files cut off at any byte", "[io][malformed]") {
    for (const auto& [name, bytes] : samples()) {
        INFO(name);
        for (std::size_t n = 0; n < bytes.size(); ++n)
            survives(bytes.substr(0, n), name);
    }
}

TEST_CASE("files with flipped, lost, doubled and foreign bytes", "[io][malformed]") {
    std::mt19937 random(20240607);
    const std::string foreign[] = {"nan",
                                   "-1",
                                   "1e400",
                                   "99999999999999999999",
                                   "4294967296",
                                   "2147483647",
                                   "-2147483648",
                                   "\n",
                                   "\r",
                                   "\t",
                                   "POINTS 999999999 float\n",
                                   "f 1 2 3 4 5 6 7 8\n",
                                   "<",
                                   ">",
                                   "\"",
                                   "\\\n",
                                   "#",
                                   "0",
                                   std::string(1, '\0'),
                                   "\xff\xff\xff\xff"};
    for (const auto& [name, bytes] : samples()) {
        INFO(name);
        int good = 0, bad = 0;
        for (int round = 0; round < 5000; ++round) {
            std::string damaged = bytes;
            const int changes = 1 + static_cast<int>(random() % 4);
            for (int i = 0; i < changes && !damaged.empty(); ++i) {
                const std::size_t at = random() % damaged.size();
                switch (random() % 5) {
                case 0:
                    damaged[at] = static_cast<char>(random());
                    break;
                case 1:
                    damaged[at] = static_cast<char>(damaged[at] ^ (1 << (random() % 8)));
                    break;
                case 2:
                    damaged.erase(at, 1 + random() % 8);
                    break;
                case 3:
                    damaged.insert(at, damaged.substr(random() % damaged.size(), random() % 40));
                    break;
                default:
                    damaged.replace(at, random() % 6, foreign[random() % std::size(foreign)]);
                }
            }
            ++(survives(damaged, name) ? good : bad);
        }
        CHECK(good > 0); // the damage is not so heavy that everything ends in the first line
        CHECK(bad > 0);
    }
}
