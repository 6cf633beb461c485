#include "fascicle/base/error.hpp"
#include "fascicle/base/text.hpp"
#include "fascicle/io/files.hpp"
#include "io/formats/vtp.hpp"
#include "support/growth.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>
#include <sstream>

using namespace fascicle;
using namespace fascicle::test;
using Catch::Matchers::Contains;

namespace {

MeshData read(const std::string& text) {
    return io::read_vtp(text, "a.vtp");
}

std::string written(const MeshData& data) {
    std::ostringstream out;
    io::write_vtp(out, data);
    return out.str();
}

std::string file(const std::string& counts, const std::string& inside, const std::string& more = "") {
    return "<?xml version=\"1.0\"?>\n<!-- x -->\n<VTKFile type=\"PolyData\" version=\"0.1\"" + more +
           ">\n<PolyData>\n<Piece " + counts + ">\n" + inside + "\n</Piece></PolyData></VTKFile>\n";
}

std::string array(const std::string& name, const std::string& text, const std::string& type = "Float32",
                  const std::string& format = "ascii") {
    return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" format=\"" + format + "\">" + text +
           "</DataArray>";
}

const std::string three = "NumberOfPoints=\"3\" NumberOfPolys=\"1\"";
const std::string points = "<Points>" + array("p", "0 0 0 1 0 0 0 1 0") + "</Points>";
const std::string triangle =
    "<Polys>" + array("connectivity", "0 1 2", "Int32") + array("offsets", "3", "Int32") + "</Polys>";

} // namespace

TEST_CASE("VTP: written and read again is the same, to the last bit", "[io][vtp]") {
    MeshData data;
    data.mesh = sphere(1.0 / 7.0, 2, Vec3(1e6, -1e-6, 0.1));
    data.point_arrays = {{"depth", 1, {}}, {"a <b> & \"c\"", 3, {}}};
    for (const Vec3& p : data.mesh.positions) {
        data.point_arrays[0].values.push_back(p.x() / 3);
        for (int k = 0; k < 3; ++k)
            data.point_arrays[1].values.push_back(p[k] * 1e-300);
    }
    const MeshData again = read(written(data));
    CHECK(again.mesh.positions == data.mesh.positions);
    CHECK(again.mesh.triangles == data.mesh.triangles);
    REQUIRE(again.point_arrays.size() == 2);
    for (std::size_t i = 0; i < 2; ++i) {
        CHECK(again.point_arrays[i].name == data.point_arrays[i].name);
        CHECK(again.point_arrays[i].components == data.point_arrays[i].components);
        CHECK(again.point_arrays[i].values == data.point_arrays[i].values);
    }
}

TEST_CASE("VTP: polylines with an array per line", "[io][vtp]") {
    MeshData data;
    data.lines = {{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0)}, {{0, 1, 2}, {2, 0}}};
    data.line_arrays = {{"fibre_id", 1, {7, 9}}};
    const MeshData again = read(written(data));
    CHECK(again.lines.points == data.lines.points);
    CHECK(again.lines.lines == data.lines.lines);
    REQUIRE(again.line_arrays.size() == 1);
    CHECK(again.line_arrays[0].values == std::vector<double>{7, 9});
    CHECK(again.mesh.positions.empty());
}

TEST_CASE("VTP: what others write", "[io][vtp]") {
    CHECK(read(file(three, points + triangle)).mesh.triangles == std::vector<Tri>{{0, 1, 2}});
    // Several pieces, strips, polygons of four, empty elements, text arrays.
    const MeshData two =
        read("<VTKFile type=\"PolyData\"><PolyData><FieldData><Array type=\"String\"/></FieldData>"
             "<Piece " +
             three + ">" + points + triangle + "<Verts/><PointData>" + array("n", "1 2 3") +
             array("t", "a b c", "String") +
             "</PointData></Piece>"
             "<Piece NumberOfPoints=\"4\" NumberOfStrips=\"1\" NumberOfPolys=\"1\"><Points>" +
             array("p", "0 0 0 1 0 0 1 1 0 0 1 0") + "</Points><PointData>" + array("n", "4 5 6 7") +
             "</PointData><Strips>" + array("connectivity", "0 1 3 2") + array("offsets", "4") +
             "</Strips><Polys>" + array("connectivity", "0 1 2 3") + array("offsets", "4") +
             "</Polys></Piece></PolyData></VTKFile>");
    CHECK(two.mesh.positions.size() == 7);
    CHECK(two.mesh.triangles == std::vector<Tri>{{0, 1, 2}, {3, 4, 6}, {6, 4, 5}, {3, 4, 5}, {3, 5, 6}});
    REQUIRE(two.point_arrays.size() == 1);
    CHECK(two.point_arrays[0].values == std::vector<double>{1, 2, 3, 4, 5, 6, 7});
    // Inline base64: 9 little-endian floats with a UInt32 length before them.
    const std::string base64 =
        "<Points>" +
        array("p", "JAAAAAAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAA==", "Float32", "binary") +
        "</Points>";
    CHECK(read(file(three, base64 + triangle, " byte_order=\"LittleEndian\"")).mesh.positions ==
          Points{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)});
}

TEST_CASE("VTP: an array that not every piece has is passed over, not cut short", "[io][vtp]") {
    const std::string text =
        read_file(std::string(FASCICLE_SOURCE_DIR) + "/fuzz/corpus/mesh_vtp/pieces_array");
    const MeshData data = io::read_vtp(text, "a.vtp");
    CHECK(data.mesh.positions.size() == 8);
    CHECK(data.point_arrays.empty());
    REQUIRE(data.notes.size() == 1);
    CHECK_THAT(data.notes[0], Contains("'a' is not in every piece"));
}

TEST_CASE("VTP: pieces of very many arrays are put together quickly, arrays of one name in their order",
          "[io][vtp]") {
    const auto pieces = [](int arrays) {
        std::string data;
        for (int i = 0; i < arrays; ++i)
            data += array("a" + std::to_string(i), std::to_string(i));
        const std::string one = "<Points>" + array("p", "0 0 0") + "</Points><PointData>" +
                                array("twice", "1") + array("twice", "2") + data + "</PointData>";
        const std::string counts = "NumberOfPoints=\"1\"";
        return file(counts, one + "</Piece><Piece " + counts + ">" + one);
    };
    const MeshData found = read(pieces(3));
    REQUIRE(found.point_arrays.size() == 5);
    CHECK(found.point_arrays[0].values == std::vector<double>{1, 1});
    CHECK(found.point_arrays[1].values == std::vector<double>{2, 2});
    CHECK(found.point_arrays[2].values == std::vector<double>{0, 0});
    CHECK(found.point_arrays[4].values == std::vector<double>{2, 2});
    CHECK(found.notes.empty());
    CHECK(growth(10000, [&](int n) { CHECK(read(pieces(n)).point_arrays.size() == std::size_t(n) + 2); }) <
          9);
}

TEST_CASE("VTP: names of arrays that are no text of XML are written as text", "[io][vtp]") {
    MeshData data;
    data.mesh = tetrahedron();
    for (const char* name : {"caf\xE9", "\xC0\x80", "b\x1B[2Jc", "\xEF\xBF\xBF", "gro\xC3\x9F"})
        data.point_arrays.push_back({name, 1, {1, 2, 3, 4}});
    const std::string text = written(data);
    CHECK(valid_utf8(text) == text);
    CHECK(text.find('\x1B') == std::string::npos);
    const MeshData again = read(text);
    REQUIRE(again.point_arrays.size() == 5);
    CHECK(again.point_arrays[0].name == "caf\xEF\xBF\xBD");
    CHECK(again.point_arrays[1].name == "\xEF\xBF\xBD\xEF\xBF\xBD");
    CHECK(again.point_arrays[2].name == "b [2Jc");
    CHECK(again.point_arrays[3].name == "\xEF\xBF\xBD");
    CHECK(again.point_arrays[4].name == "gro\xC3\x9F");
    CHECK(written(again) == text);
}

TEST_CASE("VTP: mistakes name the line", "[io][vtp]") {
    const auto fails = [](const std::string& text, const std::string& words) {
        INFO(text);
        CHECK_THROWS_WITH(read(text), Contains("a.vtp, line ") && Contains(words));
        CHECK_THROWS_AS(read(text), Error);
    };
    fails("", "no polydata");
    fails("<a></b>", "outermost");
    fails("<VTKFile type=\"ImageData\"></VTKFile>", "expected PolyData");
    fails("<VTKFile type=\"PolyData\">", "ends too early");
    fails(file(three, triangle), "a piece without <Points>");
    fails(file(three, "<Points>" + array("p", "0 0 0") + "</Points>" + triangle), "3 coordinates");
    fails(file(three, "<Points>" + array("p", "0 0 0 1 0 0 0 x 0") + "</Points>" + triangle), "got 'x'");
    fails(file(three, "<Points>" + array("p", "0 0 0 1 0 0 0 nan 0") + "</Points>" + triangle), "vertex 2");
    fails(file("NumberOfPoints=\"99999999999\"", points), "a count");
    fails(file("NumberOfPoints=\"100000000\"", points), "9 coordinates");
    const auto cells = [&](const std::string& c, const std::string& o) {
        return file(three, points + "<Polys>" + array("connectivity", c) + array("offsets", o) + "</Polys>");
    };
    fails(cells("0 1 3", "3"), "vertex index 3");
    fails(cells("0 1 -1", "3"), "vertex index -1");
    fails(cells("0 1 1.5", "3"), "vertex index 1.5");
    fails(cells("0 1 nan", "3"), "out of range");
    fails(cells("0 1 2", "4"), "offset 4");
    fails(cells("0 1 2", "-1"), "offset -1");
    fails(cells("0 1 2", "2"), "cell 0 has 2 points");
    fails(cells("0 1 2", "3 3"), "2 offsets for 1 cells");
    fails(file(three, "<Points>" + array("p", "0", "Float32", "appended") + "</Points>"), "offset is ''");
    fails(file(three, "<Points>" + array("p", "????", "Float32", "binary") + "</Points>"), "base64");
    fails(file(three, "<Points>" + array("p", "/////w==", "Float32", "binary") + "</Points>"), "4294967295");
    fails(file(three, "<Points>" + array("p", "AAAA", "Float32", "binary") + "</Points>",
               " compressor=\"vtkZLibDataCompressor\""),
          "binary data end too early");
    fails(file(three, points + triangle + "<!DOCTYPE a [<!ENTITY b \"c\">]>"), "a document type");
    std::string deep;
    for (int i = 0; i < 500; ++i)
        deep += "<a>";
    fails(deep, "outermost");
    fails("<VTKFile type=\"PolyData\">" + deep, "nested too deeply");
}
