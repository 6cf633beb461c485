#include "fascicle/base/error.hpp"
#include "io/formats/obj.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <sstream>

using namespace fascicle;
using namespace fascicle::test;
using Catch::Matchers::Contains;

namespace {

MeshData read(std::string_view text) {
    return io::read_obj(text, "a.obj");
}

const std::string corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

} // namespace

TEST_CASE("OBJ: polygons, index forms, negative indices, other lines", "[io][obj]") {
    const MeshData data =
        read("# a comment\nmtllib x.mtl\no thing\n" + corners +
             "vt 0 0\nvn 0 0 1\ng part\nusemtl y\ns off\n"
             "f 1 2 3 4\nf 1/1 2/1 3/1\nf 1//1 3//1 4//1\nf 1/1/1 2/1/1 4/1/1\nf -4 -3 -2\n");
    CHECK(data.mesh.positions == Points{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)});
    CHECK(data.mesh.triangles ==
          std::vector<Tri>{{0, 1, 2}, {0, 2, 3}, {0, 1, 2}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}});
    CHECK(data.lines.lines.empty());
}

TEST_CASE("OBJ: negative indices count back from where they stand", "[io][obj]") {
    const MeshData data = read(corners + "f -1 -2 -3\nv 5 5 5\nf -1 -2 -3\n");
    CHECK(data.mesh.triangles == std::vector<Tri>{{3, 2, 1}, {4, 3, 2}});
}

TEST_CASE("OBJ: line ends, continued lines, tabs, comments, signs, no last line end", "[io][obj]") {
    const MeshData data =
        read("v\t+0  -0.0 1e0\r\nv 1. .5 -1.5E+2 # here\r\nv 0 1 0 1.0\r\n\r\nf 1 \\\r\n 2 \\\r\n3");
    REQUIRE(data.mesh.vertex_count() == 3);
    CHECK(data.mesh.positions[1] == Vec3(1, 0.5, -150));
    CHECK(data.mesh.triangles == std::vector<Tri>{{0, 1, 2}});
    CHECK(read("v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r").mesh.triangles.size() == 1);
    CHECK(read("f 1 2 3\n" + corners).mesh.triangles.size() == 1); // vertices may follow
}

TEST_CASE("OBJ: polylines", "[io][obj]") {
    const MeshData data = read(corners + "l 1 2 3\nl -1 -2\n");
    CHECK(data.lines.lines == std::vector<std::vector<int>>{{0, 1, 2}, {3, 2}});
    CHECK(data.lines.points.size() == 4);
    CHECK(data.mesh.positions.empty());
    CHECK(read(corners + "l 1 2\nf 1 2 3\n").mesh.positions.size() == 4);
}

TEST_CASE("OBJ: every mistake names file and line", "[io][obj]") {
    const auto fails = [](const std::string& text, const std::string& place, const std::string& words) {
        INFO(text);
        CHECK_THROWS_WITH(read(text), Contains("a.obj, line " + place) && Contains(words));
        CHECK_THROWS_AS(read(text), Error);
    };
    fails(corners + "f 1 2\n", "5:", "face of 2 vertices; expected at least 3");
    fails(corners + "f\n", "5:", "face of 0");
    fails(corners + "f 1 2 5\n", "5:", "vertex index 5 is out of range; expected 1 to 4");
    fails(corners + "f 1 2 -5\n", "5:", "vertex index -5");
    fails(corners + "f 1 2 0\n", "5:", "bad index '0'");
    fails(corners + "f 1 2 x\n", "5:", "bad index 'x'");
    fails(corners + "f 1 2 3.5\n", "5:", "bad index");
    fails(corners + "f 1 2 99999999999999999999\n", "5:", "bad index");
    fails(corners + "f 1 2 2147483647\n", "5:", "out of range");
    fails(corners + "f 1 2 2147483648\n", "5:", "bad index");
    fails(corners + "f 1 2 3/1/1/1\n", "5:", "bad index");
    fails(corners + "f 1 2 /3\n", "5:", "bad index");
    fails("v 1 2\n", "1:", "vertex with 2 coordinates");
    fails("\n\nv 1 two 3\n", "3:", "got 'two'");
    fails("v 1 2 nan\n", "1:", "vertex 1 has a coordinate that is not finite");
    fails("v 1 2 3\nv -inf 2 3\n", "2:", "vertex 2 has a coordinate that is not finite");
    fails("v 1 2 1e999\n", "1:", "1e999");
    fails("v 0x10 2 3\n", "1:", "got '0x10'");
    fails(corners + "l 1\n", "5:", "line of 1 vertex");
    fails("v 0,5 1 2\n", "1:", "got '0,5'");
}

TEST_CASE("OBJ: numbers too small for a double are 0", "[io][obj]") {
    const MeshData data = read("v 1e-999 0." + std::string(400, '0') + "1 -4e-500\n");
    CHECK(data.mesh.positions[0] == Vec3(0, 0, 0));
}

TEST_CASE("OBJ: written and read again is the same, to the last bit", "[io][obj]") {
    MeshData data;
    data.mesh = sphere(1.0 / 3.0, 2, Vec3(1e-7, 123456.789, -1e15));
    std::ostringstream out;
    io::write_obj(out, data);
    const MeshData again = read(out.str());
    CHECK(again.mesh.positions == data.mesh.positions);
    CHECK(again.mesh.triangles == data.mesh.triangles);

    MeshData fibres;
    fibres.lines = {{Vec3(0.1, 0.2, 0.3), Vec3(1, 2, 3), Vec3(4, 5, 6)}, {{0, 2}, {2, 1, 0}}};
    std::ostringstream lines;
    io::write_obj(lines, fibres);
    CHECK(read(lines.str()).lines.points == fibres.lines.points);
    CHECK(read(lines.str()).lines.lines == fibres.lines.lines);
}

TEST_CASE("OBJ: told by its content", "[io][obj]") {
    CHECK(io::looks_like_obj("# x\n\no a\nv 1 2 3\n"));
    CHECK_FALSE(io::looks_like_obj(""));
    CHECK_FALSE(io::looks_like_obj("<VTKFile>\nv 1 2 3\n"));
    CHECK_FALSE(io::looks_like_obj("attachment,bone,x_mm\nv 1 2 3\n"));
    CHECK_FALSE(io::looks_like_obj(std::string("\0\1\2\3", 4)));
}
