#include "fascicle/base/error.hpp"
#include "io/formats/off.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>
#include <sstream>

using namespace fascicle;
using namespace fascicle::test;
using Catch::Matchers::Contains;

namespace {

MeshData read(std::string_view text) {
    return io::read_off(text, "a.off");
}

const std::string corners = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

} // namespace

TEST_CASE("OFF: comments, blank lines, polygons, edges, colours of faces", "[io][off]") {
    const MeshData data = read("# a\n\n OFF # b\n# c\n4 4 0\n\n" + corners +
                               "4 0 1 2 3 255 0 0 # d\n3 0 1 2\r\n2 0 2\n1 3\n\n# end\n");
    CHECK(data.mesh.positions == Points{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)});
    CHECK(data.mesh.triangles == std::vector<Tri>{{0, 1, 2}, {0, 2, 3}, {0, 1, 2}});
    CHECK(data.lines.lines == std::vector<std::vector<int>>{{0, 2}});
    CHECK(data.notes == std::vector<std::string>{"colours of faces were passed over"});
}

TEST_CASE("OFF: counts on the first line, no first word, no number of edges", "[io][off]") {
    for (const char* head : {"OFF 4 1 0\n", "OFF4 1 0\n", "4 1 0\n", "OFF\r\n4 1\r\n", "STOFF\n4 1 0\n"})
        CHECK(read(head + corners + "3 0 1 2\n").mesh.triangles.size() == 1);
}

TEST_CASE("OFF: normals and colours are arrays", "[io][off]") {
    const MeshData data = read("CNOFF\n3 1 0\n0 0 0 0 0 1 255 128 0 255\n1 0 0 0 0 1 0 0 0 255\n"
                               "0 1 0 0 0 1 1 2 3 4\n3 0 1 2\n");
    REQUIRE(data.point_arrays.size() == 2);
    CHECK(data.point_arrays[0].name == "Normals");
    CHECK(data.point_arrays[0].values == std::vector<double>{0, 0, 1, 0, 0, 1, 0, 0, 1});
    CHECK(data.point_arrays[1].name == "RGBA");
    CHECK(data.point_arrays[1].values == std::vector<double>{255, 128, 0, 255, 0, 0, 0, 255, 1, 2, 3, 4});
    const MeshData three = read("COFF\n3 1 0\n0 0 0 1 0 0.5\n1 0 0 0 0 0\n0 1 0 0 0 0\n3 0 1 2\n");
    REQUIRE(three.point_arrays.size() == 1);
    CHECK(three.point_arrays[0].name == "RGB");
    CHECK(three.point_arrays[0].values[2] == 0.5);
}

TEST_CASE("OFF: mistakes name the line", "[io][off]") {
    const auto fails = [](const std::string& text, const std::string& line, const std::string& words) {
        INFO(text);
        CHECK_THROWS_WITH(read(text), Contains("a.off, line " + line) && Contains(words));
        CHECK_THROWS_AS(read(text), Error);
    };
    fails("OFF BINARY\n", "1", "a binary OFF file");
    fails("4OFF\n1 0 0\n", "1", "three dimensions");
    fails("nOFF\n3\n1 0 0\n", "1", "three dimensions");
    fails("OFF\n", "2", "ends too early; expected the numbers of vertices");
    fails("OFF\n4\n", "2", "the line ends too early; expected the number of faces");
    fails("OFF\n4 x 0\n", "2", "got 'x'");
    fails("OFF\n-4 1 0\n", "2", "got -4");
    fails("OFF\n2147483648 1 0\n", "2", "got 2147483648");
    fails("OFF\n200000000 1 0\n" + corners, "2", "do not fit");
    fails("OFF\n4 1 0\n" + corners, "7", "expected a face");
    fails("OFF\n4 1 0\n0 0\n" + corners, "3", "three coordinates");
    fails("OFF\n4 1 0\n0 0 nan\n" + corners, "3", "vertex 0 has a coordinate that is not finite");
    fails("OFF\n4 1 0\n" + corners + "3 0 1 4\n", "7", "vertex index 4 is out of range; expected 0 to 3");
    fails("OFF\n4 1 0\n" + corners + "3 0 1 -1\n", "7", "vertex index -1");
    fails("OFF\n4 1 0\n" + corners + "3 0 1\n", "7", "the line ends too early");
    fails("OFF\n4 1 0\n" + corners + "-3 0 1\n", "7", "got -3");
    fails("OFF\n4 1 0\n" + corners + "999999999999 0 1\n", "7", "got 999999999999");
    fails("COFF\n2 0 0\n0 0 0 1 2 3 4\n0 0 0 1 2\n", "4", "a colour of 2 numbers; expected 4");
    fails("NOFF\n1 0 0\n0 0 0 1 2\n", "3", "a normal");
}

TEST_CASE("OFF: written and read again is the same, to the last bit, with normals and colours", "[io][off]") {
    MeshData data;
    data.mesh = sphere(1.0 / 3.0, 1, Vec3(1e-7, 123456.789, -1e15));
    data.mesh.positions.emplace_back(9, 9, 9); // no triangle uses it
    const auto n = data.mesh.positions.size();
    for (const bool alpha : {false, true}) {
        data.point_arrays = {{alpha ? "RGBA" : "RGB", alpha ? 4 : 3, {}}, {"Normals", 3, {}}};
        for (std::size_t i = 0; i < n * (alpha ? 4 : 3); ++i)
            data.point_arrays[0].values.push_back(static_cast<double>(i % 256));
        for (std::size_t i = 0; i < 3 * n; ++i)
            data.point_arrays[1].values.push_back(1.0 / static_cast<double>(i + 3));
        std::ostringstream out;
        io::write_off(out, data);
        const MeshData again = read(out.str());
        CHECK(again.mesh.positions == data.mesh.positions);
        CHECK(again.mesh.triangles == data.mesh.triangles);
        REQUIRE(again.point_arrays.size() == 2);
        CHECK(again.point_arrays[0].values == data.point_arrays[1].values);
        CHECK(again.point_arrays[1].name == data.point_arrays[0].name);
        CHECK(again.point_arrays[1].values == data.point_arrays[0].values);
    }
}
