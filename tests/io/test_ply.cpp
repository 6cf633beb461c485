#include "fascicle/base/error.hpp"
#include "io/formats/ply.hpp"
#include "support/shapes.hpp"

#include <bit>
#include <catch2/catch.hpp>
#include <sstream>

using namespace fascicle;
using namespace fascicle::test;
using Catch::Matchers::Contains;

namespace {

MeshData read(std::string_view text) {
    return io::read_ply(text, "a.ply");
}

std::string head(const std::string& format, const std::string& elements) {
    return "ply\nformat " + format + " 1.0\ncomment x y\nobj_info z\n" + elements + "end_header\n";
}

const std::string xyz = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
const std::string faces = "element face 1\nproperty list uchar int vertex_indices\n";
const std::string corners = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

/// Appends a number as bytes of either order.
struct Bytes {
    bool big = false;
    std::string text = {};
    template <typename T>
    Bytes& put(std::initializer_list<double> values) {
        for (const double v : values) {
            const T value = static_cast<T>(v);
            std::array<char, sizeof(T)> raw;
            std::memcpy(raw.data(), &value, sizeof(T));
            if (big != (std::endian::native == std::endian::big))
                std::reverse(raw.begin(), raw.end());
            text.append(raw.data(), raw.size());
        }
        return *this;
    }
};

} // namespace

TEST_CASE("PLY, ascii: polygons, other elements and properties, lists anywhere", "[io][ply]") {
    const MeshData data =
        read(head("ascii",
                  "element camera 1\nproperty list int float views\nproperty int id\n"
                  "element vertex 4\nproperty list uchar int used_by\nproperty double z\nproperty double x\n"
                  "property float quality\nproperty double y\n"
                  "element face 2\nproperty uchar flag\nproperty list uchar uint vertex_index\n"
                  "property list uchar float texcoord\nelement nothing 5\nelement last 1\nproperty int a\n") +
             "2 0.5 0.25 7\n2 0 1 0 0 0.5 0\n0 0 1 1.5 0\n1 9 0 1 2.5 1\n0 0 0 3.5 1\n"
             "1 4 0 1 2 3 2 0.5 0.5\n0 3 0 1 2 0\n42\n");
    CHECK(data.mesh.positions == Points{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)});
    CHECK(data.mesh.triangles == std::vector<Tri>{{0, 1, 2}, {0, 2, 3}, {0, 1, 2}});
    REQUIRE(data.point_arrays.size() == 1);
    CHECK(data.point_arrays[0].name == "quality");
    CHECK(data.point_arrays[0].values == std::vector<double>{0.5, 1.5, 2.5, 3.5});
    CHECK(data.notes ==
          std::vector<std::string>{"properties of faces other than their vertices were passed over"});
}

TEST_CASE("PLY, binary: both byte orders, every type of number", "[io][ply]") {
    const bool big = GENERATE(false, true);
    Bytes bytes;
    bytes.big = big;
    for (int v = 0; v < 3; ++v)
        bytes.put<std::int8_t>({-1.0 - v})
            .put<std::uint8_t>({200})
            .put<std::int16_t>({-300})
            .put<std::uint16_t>({60000})
            .put<std::int32_t>({-70000})
            .put<std::uint32_t>({4e9})
            .put<float>({0.5, 1.0 * v})
            .put<double>({0.1, v == 1 ? 1.0 : 0.0})
            .put<float>({7});
    bytes.put<std::uint16_t>({3}).put<std::int16_t>({0, 1, 2}).put<std::uint16_t>({3}).put<std::int16_t>(
        {2, 1, 0});
    const std::string type = big ? "binary_big_endian" : "binary_little_endian";
    const MeshData data = read(
        head(type, "element vertex 3\nproperty char a\nproperty uint8 b\nproperty int16 c\nproperty ushort "
                   "d\nproperty int e\nproperty uint32 f\nproperty float32 g\nproperty float x\nproperty "
                   "float64 h\nproperty double y\nproperty float z\nelement face 2\nproperty list "
                   "ushort short vertex_indices\n") +
        bytes.text);
    CHECK(data.mesh.positions == Points{Vec3(0, 0, 7), Vec3(1, 1, 7), Vec3(2, 0, 7)});
    CHECK(data.mesh.triangles == std::vector<Tri>{{0, 1, 2}, {2, 1, 0}});
    const double first[] = {-1, 200, -300, 60000, -70000, 4e9, 0.5, 0.1};
    REQUIRE(data.point_arrays.size() == 8);
    for (std::size_t i = 0; i < 8; ++i) {
        CHECK(data.point_arrays[i].name == std::string(1, static_cast<char>('a' + i)));
        CHECK(data.point_arrays[i].values[0] == first[i]);
    }
}

TEST_CASE("PLY: normals, colours and numbered properties are arrays of several components", "[io][ply]") {
    const MeshData data =
        read(head("ascii",
                  "element vertex 1\nproperty float x\nproperty float y\nproperty float z\nproperty uchar "
                  "red\nproperty uchar green\nproperty uchar blue\nproperty float nx\nproperty float "
                  "ny\nproperty float nz\nproperty double t_0\nproperty double t_1\nproperty float u_1\n") +
             "0 0 0 10 20 30 0 0 1 0.5 0.25 3\n");
    REQUIRE(data.point_arrays.size() == 4);
    CHECK(data.point_arrays[0].name == "RGB");
    CHECK(data.point_arrays[0].values == std::vector<double>{10, 20, 30});
    CHECK(data.point_arrays[1].name == "Normals");
    CHECK(data.point_arrays[2].name == "t");
    CHECK(data.point_arrays[2].values == std::vector<double>{0.5, 0.25});
    CHECK(data.point_arrays[3].name == "u_1");
    CHECK(data.point_arrays[3].components == 1);
}

TEST_CASE("PLY: line ends, faces before vertices, strips, edges, points alone", "[io][ply]") {
    std::string crlf;
    for (const char c : head("ascii", faces + xyz) + "3 0 1 3\n" + corners)
        crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
    CHECK(read(crlf).mesh.triangles == std::vector<Tri>{{0, 1, 3}});
    Bytes bytes;
    bytes.put<float>(
        {10, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}); // begins with the byte of a line feed? no: see below
    std::string cr = head("binary_little_endian", xyz);
    std::replace(cr.begin(), cr.end(), '\n', '\r');
    std::string data = bytes.text;
    data[0] = '\n'; // the first byte of the data is no part of the line's end
    CHECK(read(cr + data).mesh.positions.size() == 4);
    CHECK(read(head("ascii", xyz + "element tristrips 1\nproperty list int int vertex_indices\n") + corners +
               "8 0 1 3 2 -1 0 1 2\n")
              .mesh.triangles == std::vector<Tri>{{0, 1, 3}, {3, 1, 2}, {0, 1, 2}});
    const MeshData edges =
        read(head("ascii",
                  xyz + "element edge 2\nproperty int vertex1\nproperty int vertex2\nproperty uchar red\n") +
             corners + "0 1 9\n2 3 9\n");
    CHECK(edges.lines.lines == std::vector<std::vector<int>>{{0, 1}, {2, 3}});
    CHECK(edges.mesh.positions.empty());
    CHECK(read(head("ascii", xyz) + corners).mesh.positions.size() == 4);
}

TEST_CASE("PLY: mistakes name line or byte", "[io][ply]") {
    const auto fails = [](const std::string& text, const std::string& place, const std::string& words) {
        INFO(text);
        CHECK_THROWS_WITH(read(text), Contains("a.ply, " + place) && Contains(words));
        CHECK_THROWS_AS(read(text), Error);
    };
    fails("", "line 1", "not a PLY file");
    fails("ply\n", "line 2", "the header ends too early");
    fails("ply\nend_header\n", "line 2", "no format");
    fails("ply\nformat text 1.0\n", "line 2", "got 'text'");
    fails("ply\nformat ascii 1.0\nproperty int x\n", "line 3", "before any element");
    fails("ply\nformat ascii 1.0\nelement vertex -1\n", "line 3", "got -1");
    fails("ply\nformat ascii 1.0\nelement vertex 99999999999999999999\n", "line 3", "number of an element");
    fails("ply\nformat ascii 1.0\nelement v 1\nproperty complex x\n", "line 4", "unknown type 'complex'");
    fails("ply\nformat ascii 1.0\nelement v 1\nproperty list float int x\n", "line 4", "not whole");
    fails("ply\nformat ascii 1.0\nhello\n", "line 3", "unknown word 'hello'");
    fails(head("ascii", "element vertex 1\nproperty float x\nproperty float y\n") + "0 0\n", "line 5",
          "without z");
    fails(head("ascii", "element vertex 0\nelement face 1\nproperty int a\n") + "0\n", "line 6",
          "faces without vertices");
    fails(head("ascii", xyz + xyz) + corners + corners, "line 9", "a second element vertex");
    fails(head("ascii", "element vertex 4\n") + corners, "line 5", "without properties");
    fails(head("ascii", xyz) + "0 0 0\n", "line 10", "4 of the element 'vertex'");
    fails(head("ascii", xyz) + "0.0 0.0 0.0\n1.0 2.0\n3 4 5\nx y z\n", "line 13", "got 'x'");
    fails(head("ascii", xyz) + "0 0 inf\n1 2 3\n3 4 5\n0 0 0\n", "line 10", "vertex 0 has a coordinate");
    fails(head("ascii", xyz + faces) + corners + "3 0 1 4\n", "line 16", "vertex index 4 is out of range");
    fails(head("ascii", xyz + faces) + corners + "3 0 1 -2\n", "line 16", "vertex index -2");
    fails(head("ascii", xyz + faces) + corners + "2 0 1\n", "line 16", "face of 2 vertices");
    fails(head("ascii", xyz + faces) + corners + "-3 0 1\n", "line 16", "a list of -3 numbers");
    fails(head("ascii", xyz + faces) + corners + "3 0 1.5 2\n", "line 16", "not whole");
    for (const char* count : {"2147483648", "9223372036854775807"})
        for (const char* format : {"ascii", "binary_little_endian"})
            for (const char* element : {"vertex", "face", "other"}) {
                const std::string properties = element == std::string("face")
                                                   ? "property list uchar int vertex_indices\n"
                                                   : "property float x\nproperty float y\nproperty float z\n";
                INFO(element);
                CHECK_THROWS_WITH(
                    read(head(format, std::string("element ") + element + " " + count + "\n" + properties) +
                         corners),
                    Contains("the file ends too early"));
            }
    Bytes bytes;
    bytes.put<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}).put<std::int32_t>({2147483647.0, 0, 1, 2});
    const std::string long_list =
        head("binary_little_endian", xyz + "element face 1\nproperty list int int vertex_indices\n");
    fails(long_list + bytes.text, "byte " + std::to_string(long_list.size() + 48),
          "a list of 2147483647 numbers");
    fails(head("binary_little_endian", xyz) + "short", "byte", "ends too early");
}

TEST_CASE("PLY: written and read again is the same, to the last bit, with arrays of any name", "[io][ply]") {
    MeshData data;
    data.mesh = sphere(1.0 / 7.0, 2, Vec3(1e6, -1e-6, 0.1));
    const std::size_t n = data.mesh.positions.size();
    const auto add = [&](const std::string& name, int components, bool bytes = false) {
        NamedArray array{name, components, {}};
        for (std::size_t i = 0; i < n * static_cast<std::size_t>(components); ++i)
            array.values.push_back(bytes ? static_cast<double>(i % 256)
                                         : 1e-300 / static_cast<double>(i + 3));
        data.point_arrays.push_back(std::move(array));
    };
    add("depth", 1);
    add("RGBA", 4, true);
    add("tangent", 3);
    for (const char* name : {"x", "nx", "red", "alpha", "a_0", "a_1", "two words, 100 %", "größer", ""})
        add(name, 1);
    add(std::string(500, '\0') + std::string(1000, 'n'), 1); // each NUL takes three letters
    add("Normals", 3);
    add("RGB", 3); // no bytes
    add("a_0", 2);
    std::ostringstream out;
    io::write_ply(out, data);
    const MeshData again = read(out.str());
    CHECK(again.mesh.positions == data.mesh.positions);
    CHECK(again.mesh.triangles == data.mesh.triangles);
    REQUIRE(again.point_arrays.size() == data.point_arrays.size());
    for (std::size_t i = 0; i < again.point_arrays.size(); ++i) {
        // A name without letters is a blank in formats that want a word.
        CHECK(again.point_arrays[i].name ==
              (data.point_arrays[i].name.empty() ? " " : data.point_arrays[i].name));
        CHECK(again.point_arrays[i].components == data.point_arrays[i].components);
        CHECK(again.point_arrays[i].values == data.point_arrays[i].values);
    }
}
