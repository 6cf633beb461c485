#include "fascicle/base/error.hpp"
#include "io/formats/vtk_legacy.hpp"
#include "support/shapes.hpp"

#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <sstream>

using namespace fascicle;
using namespace fascicle::test;
using Catch::Matchers::Contains;

namespace {

MeshData read(const std::string& text) {
    return io::read_vtk_legacy(text, "a.vtk");
}

std::string head(const std::string& kind, const std::string& version = "3.0") {
    return "# vtk DataFile Version " + version + "\ntitle\n" + kind + "\nDATASET POLYDATA\n";
}

/// Big-endian bytes.
template <typename T>
std::string be(std::initializer_list<T> values) {
    std::string out;
    for (const T& value : values) {
        const auto* bytes = reinterpret_cast<const char*>(&value);
        for (std::size_t i = sizeof value; i-- > 0;)
            out += bytes[i];
    }
    return out;
}

const std::string ascii_points = "POINTS 4 float\n0 0 0 1 0 0\n1 1 0 0 1 0\n";
const Points square{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)};
const std::string binary_points =
    std::string("POINTS 4 float\n") + be<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}) + "\n";

} // namespace

TEST_CASE("legacy VTK, ASCII: polygons, strips, lines, vertices", "[io][vtk]") {
    const MeshData data = read(head("ASCII") + ascii_points +
                               "VERTICES 1 2\n1 0\nLINES 2 7\n3 0 1 2\n2 3 0\n"
                               "POLYGONS 2 9\n4 0 1 2 3\n3 0 1 2\nTRIANGLE_STRIPS 1 5\n4 0 1 3 2\n");
    CHECK(data.mesh.positions == square);
    CHECK(data.mesh.triangles == std::vector<Tri>{{0, 1, 2}, {0, 2, 3}, {0, 1, 2}, {0, 1, 3}, {3, 1, 2}});
    CHECK(data.lines.lines == std::vector<std::vector<int>>{{0, 1, 2}, {3, 0}});
    CHECK(data.lines.points == square);
}

TEST_CASE("legacy VTK: versions, cases, line ends", "[io][vtk]") {
    const std::string version = GENERATE("1.0", "2.0", "3.0", "4.2", "5.0");
    const MeshData data =
        read("# vtk DataFile Version " + version +
             "\r\n\r\nascii\r\ndataset PolyData\r\npoints 3 DOUBLE\r\n0 0 0\r\n1 0 0\r\n0 1 0\r\n"
             "\r\nPolygons 1 4\r\n3 0 1 2");
    CHECK(data.mesh.triangles == std::vector<Tri>{{0, 1, 2}});
}

TEST_CASE("legacy VTK 5.1: offsets and connectivity", "[io][vtk]") {
    const MeshData ascii =
        read(head("ASCII", "5.1") + ascii_points +
             "METADATA\nINFORMATION 0\n\nPOLYGONS 3 7\nOFFSETS vtktypeint64\n0 4 7\nCONNECTIVITY "
             "vtktypeint64\n0 1 2 3 0 1\n2\n");
    CHECK(ascii.mesh.triangles == std::vector<Tri>{{0, 1, 2}, {0, 2, 3}, {0, 1, 2}});
    const MeshData binary =
        read(head("BINARY", "5.1") + binary_points +
             "METADATA\nINFORMATION 0\n\nLINES 2 3\nOFFSETS "
             "vtktypeint64\n" +
             be<std::int64_t>({0, 3}) + "\nCONNECTIVITY vtktypeint64\n" + be<std::int64_t>({0, 1, 2}) +
             "\nPOLYGONS 3 7\nOFFSETS vtktypeint32\n" + be<std::int32_t>({0, 4, 7}) + "\nCONNECTIVITY int\n" +
             be<std::int32_t>({0, 1, 2, 3, 0, 1, 2}) + "\n");
    CHECK(binary.mesh.triangles == ascii.mesh.triangles);
    CHECK(binary.lines.lines == std::vector<std::vector<int>>{{0, 1, 2}});
    CHECK(binary.mesh.positions == square);
}

TEST_CASE("legacy VTK, BINARY: number types of points", "[io][vtk]") {
    const std::string cells = std::string("\nPOLYGONS 1 4\n") + be<std::int32_t>({3, 0, 1, 2}) + "\n";
    const auto points = [&](const std::string& type, const std::string& bytes) {
        const MeshData data = read(head("BINARY") + "POINTS 3 " + type + "\n" + bytes + cells);
        CHECK(data.mesh.triangles.size() == 1);
        return data.mesh.positions;
    };
    const Points expected{Vec3(0, 1, 2), Vec3(3, 4, 5), Vec3(6, 7, 120)};
    CHECK(points("float", be<float>({0, 1, 2, 3, 4, 5, 6, 7, 120})) == expected);
    CHECK(points("double", be<double>({0, 1, 2, 3, 4, 5, 6, 7, 120})) == expected);
    CHECK(points("short", be<std::int16_t>({0, 1, 2, 3, 4, 5, 6, 7, 120})) == expected);
    CHECK(points("unsigned_char", be<std::uint8_t>({0, 1, 2, 3, 4, 5, 6, 7, 120})) == expected);
    CHECK(points("long", be<std::int64_t>({0, 1, 2, 3, 4, 5, 6, 7, 120})) == expected);
    CHECK(points("int", be<std::int32_t>({0, -1, 2, 3, 4, 5, 6, 7, 1}))[0] == Vec3(0, -1, 2));
    CHECK(points("char", be<std::int8_t>({-128, 127, 2, 3, 4, 5, 6, 7, 1}))[0] == Vec3(-128, 127, 2));
    CHECK(points("unsigned_long", be<std::uint64_t>({~0ull, 0, 0, 0, 0, 0, 0, 0, 0}))[0].x() ==
          18446744073709551615.0);
}

TEST_CASE("legacy VTK: attributes of points are arrays, those of polygons passed over with a note, in both "
          "encodings",
          "[io][vtk]") {
    std::string ones;
    for (int i = 0; i < 36; ++i)
        ones += "1 ";
    const std::string polygon = "POLYGONS 1 4\n3 0 1 2\n", more = "LINES 1 3\n2 0 1\n";
    const MeshData ascii = read(
        head("ASCII") + "FIELD f 2\nnames 1 2 string\nhello%20you\n\nlevels 2 2 double\n1 2 3 4\n" +
        ascii_points + polygon +
        "CELL_DATA 1\nSCALARS s float\nLOOKUP_TABLE default\n0.5\nLOOKUP_TABLE t 2\n0 0 0 1 1 1 1 1\n"
        "SCALARS s2 int 2\nLOOKUP_TABLE t\n1 2\nMETADATA\nCOMPONENT_NAMES\na\nb\n\nVECTORS v float\n1 2 3\n"
        "POINT_DATA 4\nNORMALS n float\n0 0 1 0 0 1\n0 0 1 0 0 1\nTEXTURE_COORDINATES t 2 float\n0 0 1 0 1 1 "
        "0 1\n"
        "COLOR_SCALARS c 3\n0 0 0 1 1 1 1 1 1 0 0 0\nTENSORS t float\n" +
        ones + "\nGLOBAL_IDS g vtkIdType\n0 1 2 3\nFIELD extra 1\narr 1 4 double\n1 2 3 nan\n" + more);
    CHECK(ascii.notes == std::vector<std::string>{"arrays of cells were passed over: 's', 's2', 'v'"});
    CHECK(ascii.mesh.triangles.size() == 1);
    CHECK(ascii.lines.lines.size() == 1);
    const auto check = [](const NamedArray& array, const char* name, int components, double last) {
        CHECK(array.name == name);
        CHECK(array.components == components);
        CHECK(array.values.size() == 4 * static_cast<std::size_t>(components));
        CHECK((array.values.back() == last || (std::isnan(last) && std::isnan(array.values.back()))));
    };
    REQUIRE(ascii.point_arrays.size() == 6);
    check(ascii.point_arrays[0], "n", 3, 1);
    check(ascii.point_arrays[1], "t", 2, 1);
    check(ascii.point_arrays[2], "c", 3, 0);
    CHECK(ascii.point_arrays[2].values[3] == 255); // shares become bytes
    check(ascii.point_arrays[3], "t", 9, 1);
    check(ascii.point_arrays[4], "g", 1, 3);
    check(ascii.point_arrays[5], "arr", 1, std::nan(""));

    const MeshData binary =
        read(head("BINARY") + "FIELD f 1\nnames 1 2 string\n" + std::string("\xc2hi\xc1x", 5) + "\n" +
             binary_points + "POLYGONS 1 4\n" + be<std::int32_t>({3, 0, 1, 2}) +
             "\nCELL_DATA 1\nSCALARS s bit\nLOOKUP_TABLE default\n" + std::string("\x80", 1) +
             "\nPOINT_DATA 4\nSCALARS s double\nLOOKUP_TABLE default\n" + be<double>({1, 2, 3, 4}) +
             "\nCOLOR_SCALARS c 1\n" + be<std::uint8_t>({1, 2, 3, 4}) + "\nLOOKUP_TABLE t 1\n" +
             be<std::uint8_t>({1, 2, 3, 4}) + "\nFIELD e 1\narr 2 4 short\n" +
             be<std::int16_t>({1, 2, 3, 4, 5, 6, 7, 8}) + "\nMETADATA\nINFORMATION 0\n\nLINES 1 3\n" +
             be<std::int32_t>({2, 0, 1}) + "\n");
    CHECK(binary.notes == std::vector<std::string>{"arrays of cells were passed over: 's'"});
    CHECK(binary.mesh.triangles.size() == 1);
    CHECK(binary.lines.lines.size() == 1);
    REQUIRE(binary.point_arrays.size() == 3);
    CHECK(binary.point_arrays[0].name == "s");
    CHECK(binary.point_arrays[0].values == std::vector<double>{1, 2, 3, 4});
    CHECK(binary.point_arrays[1].name == "c");
    CHECK(binary.point_arrays[1].values == std::vector<double>{1, 2, 3, 4});
    CHECK(binary.point_arrays[2].components == 2);
    CHECK(binary.point_arrays[2].values == std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8});
}

TEST_CASE("legacy VTK: attributes that make no sense are a note, the mesh is there", "[io][vtk]") {
    const std::string mesh = head("ASCII") + ascii_points + "POLYGONS 1 4\n3 0 1 2\n";
    for (const char* tail :
         {"CELL_DATA 1\nSCALARS s float\nLOOKUP_TABLE default\n", "CELL_DATA 1\nNONSENSE a b\n",
          "POINT_DATA 4\nVECTORS v float\n1 2 3 4\n", "CELL_DATA x\n", "CELL_DATA 268435457\n",
          "POINT_DATA 268435456\nTENSORS t float\n1\n", "CELL_DATA 1\nFIELD f 3\n"}) {
        const MeshData data = read(mesh + tail);
        CHECK(data.mesh.triangles.size() == 1);
        REQUIRE(!data.notes.empty()); // the name of an array of cells may be another
        CHECK_THAT(data.notes[0], Contains("a.vtk, line 1") && !Contains("line 1:")); // lines 10 to 13
    }
}

TEST_CASE("legacy VTK: mistakes name line or byte", "[io][vtk]") {
    const auto fails = [](const std::string& text, const std::string& place, const std::string& words) {
        INFO(text);
        CHECK_THROWS_WITH(read(text), Contains("a.vtk, " + place) && Contains(words));
        CHECK_THROWS_AS(read(text), Error);
    };
    const std::string a = head("ASCII"), p = a + ascii_points;
    fails("", "line 1", "not a legacy VTK file");
    fails("# vtk DataFile Version 3.0\nt\nTEXT\n", "line 3", "got 'TEXT'; expected ASCII or BINARY");
    fails("# vtk DataFile Version 3.0\nt\nASCII\nDATASET STRUCTURED_GRID\n", "line 4", "expected POLYDATA");
    fails(a, "line 5", "ends without points");
    fails(a + "POINTS x float\n", "line 5", "got 'x'; expected the number of points");
    fails(a + "POINTS -3 float\n", "line 5", "got '-3'");
    fails(a + "POINTS 99999999999999999999 float\n", "line 5", "number of points");
    fails(a + "POINTS 200000000 float\n1 2 3\n", "line 5", "ends too early");
    fails(a + "POINTS 1 complex\n1 2 3\n", "line 5", "unknown data type 'complex'");
    fails(a + "POINTS 1 bit\n1 2 3\n", "line 5", "data type");
    fails(a + "POINTS 2 float\n1 2 3\n1 nan 3\n", "line 7", "vertex 1 has a coordinate that is not finite");
    fails(a + "POINTS 1 float\n1 b 3\n", "line 6", "got 'b'; expected the coordinate of a point");
    fails(p + "POLYGONS 1 4\n3 0 1 4\n", "line 9", "vertex index 4 is out of range; expected 0 to 3");
    fails(p + "POLYGONS 1 4\n3 0 1 -1\n", "line 9", "vertex index -1");
    fails(p + "POLYGONS 1 4\n4 0 1 2\n", "line 9", "does not fit");
    fails(p + "POLYGONS 2 4\n3 0 1 2\n", "line 9", "the cell list ends with cell 1");
    fails(p + "POLYGONS 1 9\n3 0 1 2\n0 0 0 0 0\n", "line 9", "before their list");
    fails(p + "POLYGONS 1 3\n2 0 1\n", "line 9", "polygon of 2 points");
    fails(p + "LINES 1 2\n1 0\n", "line 9", "line of 1 point");
    fails(p + "POLYGONS 1 400000000\n3 0 1 2\n", "line 8", "expected the size of the cell list");
    fails(p + "POLYGONS 1 40000000\n3 0 1 2\n", "line 8", "ends too early");
    fails(p + "BLOCKS 1 2\n", "line 8", "unknown section 'blocks'");
    fails(p + ascii_points, "line 8", "a second section POINTS");
    fails(p + "POLYGONS 2 3\nOFFSETS int\n0 4\nCONNECTIVITY int\n0 1 2\n", "line 10",
          "offset 4 is out of order");
    fails(p + "POLYGONS 2 3\nOFFSETS int\n0 2\nCONNECTIVITY int\n0 1 2\n", "line 11", "the offsets end at 2");
    fails(p + "POLYGONS 2 3\nOFFSETS int\n0 3\n0 1 2\n", "line 11", "no CONNECTIVITY");
    fails(p + "POLYGONS 3 3\nOFFSETS float\n0 3 3\nCONNECTIVITY int\n0 1 2\n", "line 9",
          "offsets of this data type");

    const std::string b = head("BINARY");
    const auto byte = [](std::size_t i) { return std::string("byte ").append(std::to_string(i)); };
    fails(b + "POINTS 4 float\n123456789", byte(b.size() + 15), "ends too early");
    fails(b + "POINTS 200000000 double\n1", "byte", "ends too early");
    fails(b + "POINTS 4 float 5\n", "byte", "no line end before binary data");
    fails(b + binary_points + "POLYGONS 1 4\n" + be<std::int32_t>({3, 0, 1, 7}),
          byte(b.size() + binary_points.size() + 13 + 12), "vertex index 7");
}

TEST_CASE("legacy VTK: written and read again is the same, to the last bit", "[io][vtk]") {
    MeshData data;
    data.mesh = torus(1.0 / 3.0, 0.1);
    data.lines = {data.mesh.positions, {{0, 1, 2}, {5, 4}}};
    std::ostringstream out;
    io::write_vtk_legacy(out, data);
    const MeshData again = read(out.str());
    CHECK(again.mesh.positions == data.mesh.positions);
    CHECK(again.mesh.triangles == data.mesh.triangles);
    CHECK(again.lines.lines == data.lines.lines);
}

TEST_CASE("legacy VTK: arrays of lines, with vertices before and polygons behind, and written again",
          "[io][vtk]") {
    const MeshData data = read(head("ASCII") + ascii_points +
                               "VERTICES 2 4\n1 0\n1 1\nLINES 2 6\n2 0 1\n2 2 3\nPOLYGONS 1 4\n3 0 1 2\n"
                               "CELL_DATA 5\nFIELD f 1\nfibre_id 2 5 unsigned_int\n0 0 0 0 7 70 9 90 0 0\n");
    REQUIRE(data.line_arrays.size() == 1);
    CHECK(data.line_arrays[0].name == "fibre_id");
    CHECK(data.line_arrays[0].values == std::vector<double>{7, 70, 9, 90});

    MeshData fibres;
    fibres.lines = {square, {{0, 1, 2}, {3, 0}}};
    fibres.line_arrays = {{"length mm", 1, {0.1, 0.2}}};
    fibres.point_arrays = {{"tangent", 3, std::vector<double>(12, 1.0 / 3)}};
    std::ostringstream out;
    io::write_vtk_legacy(out, fibres);
    const MeshData again = read(out.str());
    CHECK(again.lines.lines == fibres.lines.lines);
    REQUIRE(again.line_arrays.size() == 1);
    CHECK(again.line_arrays[0].name == "length mm");
    CHECK(again.line_arrays[0].values == fibres.line_arrays[0].values);
    REQUIRE(again.point_arrays.size() == 1);
    CHECK(again.point_arrays[0].values == fibres.point_arrays[0].values);
}
