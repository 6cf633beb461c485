#include "fascicle/base/error.hpp"
#include "io/formats/binary_numbers.hpp"
#include "io/formats/stl.hpp"
#include "io/formats/vertex_weld.hpp"
#include "io/mesh_samples.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>
#include <sstream>

using namespace fascicle;
using namespace fascicle::test;
using Catch::Matchers::Contains;

namespace {

MeshData read(std::string_view bytes) {
    return io::read_stl(bytes, "a.stl");
}

std::string binary(std::string header, const std::vector<std::array<float, 9>>& triangles) {
    header.resize(80, '\0');
    io::put_little_endian(header, triangles.size(), 4);
    for (const auto& t : triangles) {
        header.append(12, '\0');
        for (const float v : t)
            io::put_little_endian(header, std::bit_cast<std::uint32_t>(v), 4);
        header.append("\x12\x34"); // colours of some programs
    }
    return header;
}

const std::vector<std::array<float, 9>> two{{0, 0, 0, 1, 0, 0, 0, 1, 0}, {1, 0, 0, 1, 1, 0, 0, 1, -0.0f}};
const std::string facet =
    "facet normal nan 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  vertex 0 1 0\n"
    " endloop\nendfacet\n";

} // namespace

TEST_CASE("STL, binary: corners at equal coordinates are one vertex, in the order of the file", "[io][stl]") {
    const MeshData data = read(binary("made elsewhere", two));
    CHECK(data.mesh.positions == Points{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0)});
    CHECK(data.mesh.triangles == std::vector<Tri>{{0, 1, 2}, {1, 3, 2}});
    REQUIRE(data.notes.size() == 1);
    CHECK_THAT(data.notes[0], Contains("6 corners") && Contains("4 vertices"));
}

TEST_CASE("STL: the size decides where a binary file begins with solid", "[io][stl]") {
    const std::string bytes = binary("solid exported by a program that knows no better", two);
    CHECK(io::looks_like_stl(bytes));
    CHECK(read(bytes).mesh.triangles.size() == 2);
    CHECK(read("solid\n" + facet + "endsolid\n").mesh.triangles.size() == 1);
    // Neither the announced size nor text: binary with an end too many, or too few.
    const MeshData longer = read(bytes + "more");
    CHECK(longer.mesh.triangles.size() == 2);
    REQUIRE(longer.notes.size() == 2);
    CHECK_THAT(longer.notes[1], Contains("4 bytes after the last triangle"));
    CHECK_THROWS_WITH(read(bytes.substr(0, bytes.size() - 1)),
                      Contains("a.stl, byte 80") && Contains("room for 1 triangles; expected 2"));
}

TEST_CASE("STL, ascii: several solids, any case, blanks and line ends", "[io][stl]") {
    std::string upper = facet;
    for (char& c : upper)
        c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    const MeshData data = read(" \r\n solid a b\r\n" + facet + facet + "endsolid a b\r\nSOLID\r\n" + upper +
                               "color 1 2 3\nENDSOLID");
    CHECK(data.mesh.triangles == std::vector<Tri>{{0, 1, 2}, {0, 1, 2}, {0, 1, 2}});
    CHECK(data.mesh.positions.size() == 3);
    CHECK(read("solid\nendsolid\n").mesh.positions.empty());
}

TEST_CASE("STL: mistakes name line or byte", "[io][stl]") {
    const auto fails = [](const std::string& text, const std::string& place, const std::string& words) {
        INFO(text);
        CHECK_THROWS_WITH(read(text), Contains("a.stl, " + place) && Contains(words));
        CHECK_THROWS_AS(read(text), Error);
    };
    fails("", "byte 0", "ends too early");
    fails("solid\n" + facet, "line 9", "expected endsolid");
    fails("solid\nfacet normal 0 0 1\nouter loop\n", "line 4", "expected endfacet");
    fails("solid\nfacet\nvertex 0 0 0\nvertex 1 0 0\nendfacet\n", "line 5", "a triangle of 2 corners");
    fails("solid\nfacet\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nvertex 1 2 0\n", "line 6",
          "more than three");
    fails("solid\nvertex 0 0 0\n", "line 2", "vertex outside of a facet");
    fails("solid\nfacet\nvertex 0 0 zero\n", "line 3", "got 'zero'");
    fails("solid\nfacet\nvertex 0 0 inf\n", "line 3", "not finite");
    fails("solid\nfacet\nfacet\n", "line 3", "facet inside of a facet");
    fails("solid\nsolid\n", "line 2", "got 'solid'");
    fails("solid\nhello\n", "line 2", "got 'hello'");
    fails(binary("x", {{0, 0, 0, 1, 0, 0, 0, std::numeric_limits<float>::quiet_NaN(), 0}}), "byte 120",
          "triangle 0 has a coordinate that is not finite");
    std::string many = binary("x", two);
    many.replace(80, 4, "\xff\xff\xff\xff");
    fails(many, "byte 80", "expected 4294967295");
}

TEST_CASE("STL: written and read again is the same but for rounding and the order of vertices", "[io][stl]") {
    MeshData data;
    data.mesh = sphere(1.0 / 3.0, 2, Vec3(1e-7, 1234.5, -1e15));
    for (const TriMesh& mesh : {torus(2, 0.5), box(1, 2, 3)}) {
        data.mesh = mesh;
        std::ostringstream out;
        io::write_stl(out, data);
        const MeshData again = read(out.str());
        const TriMesh expected = as_stl_has_it(mesh);
        CHECK(again.mesh.positions == expected.positions);
        CHECK(again.mesh.triangles == expected.triangles);
        data.mesh = again.mesh; // a second time nothing changes at all
        std::ostringstream second;
        io::write_stl(second, data);
        CHECK((second.str() == out.str()));
    }
    std::ostringstream out;
    data.mesh = box(1e39, 1, 1);
    CHECK_THROWS_WITH(io::write_stl(out, data), Contains("that a float can hold"));
    data.mesh.triangles.clear();
    CHECK_THROWS_WITH(io::write_stl(out, data), Contains("no triangle"));
}

TEST_CASE("welding: equal points are one, near ones are not", "[io][stl]") {
    io::VertexWeld weld;
    for (int round = 0; round < 2; ++round)
        for (int i = 0; i < 1000; ++i)
            CHECK(weld.add(Vec3(i, std::nextafter(1.0, i % 2 ? 2.0 : 0.0), -i)) == i);
    CHECK(weld.add(Vec3(-0.0, std::nextafter(1.0, 0.0), 0.0)) == 0);
    CHECK(weld.points().size() == 1000);
}
