// Damaged and hostile animation files: an Error of one line that names the file, or an animation whose frames can all be read; quickly, and
// without much memory.
#include "fascicle/base/error.hpp"
#include "fascicle/io/animation_file.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/mesh_file.hpp"
#include "io/formats/gltf_read.hpp"
#include "io/formats/gltf_write.hpp"
#include "io/formats/point_cache.hpp"
#include "io/formats/usda_read.hpp"
#include "io/formats/usda_write.hpp"
#include "support/growth.hpp"
#include "support/moving_bodies.hpp"
#include "support/temp_dir.hpp"

#include <catch2/catch.hpp>
#include <cstring>
#include <limits>
#include <random>
#include <sstream>

using namespace fascicle;
using namespace fascicle::test;

namespace {

Animation small() {
    Animation animation = moving_bodies(3);
    animation.bodies.erase(animation.bodies.begin()); // the box and the fibres are enough, and short
    animation.bodies[0].points = [](std::size_t k, Points& points) {
        points.assign(6, Vec3(1, 2, static_cast<double>(k)));
        points[1].x() = 5;
    };
    return animation;
}

std::string glb_sample() {
    std::ostringstream out;
    io::write_glb(out, small(), {}, "sample");
    return out.str();
}

std::string usda_sample() {
    std::ostringstream out;
    io::write_usda(out, small());
    return out.str();
}

std::string cache_sample(bool pc2) {
    std::ostringstream out;
    const Animation animation = small();
    (pc2 ? io::write_pc2 : io::write_mdd)(out, animation.bodies[0], animation, {}, "sample");
    return out.str();
}

/// A .glb with this JSON and so many zeros.
std::string glb_of(std::string json, const std::string& binary = std::string(64, '\0')) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const auto word = [](std::size_t value) {
        const auto bits = static_cast<std::uint32_t>(value);
        std::string bytes(4, '\0');
        std::memcpy(bytes.data(), &bits, 4);
        return bytes;
    };
    return "glTF" + word(2) + word(28 + json.size() + binary.size()) + word(json.size()) + "JSON" + json +
           word(binary.size()) + std::string("BIN\0", 4) + binary;
}

const std::string head = "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":64}],";

using Read = Animation (*)(std::string_view, const std::string&);

Animation read_cache(std::string_view bytes, const std::string& file) {
    const io::PointCache cache =
        bytes.substr(0, 4) == "POIN" ? io::read_pc2(bytes, file) : io::read_mdd(bytes, file);
    Points points;
    for (std::size_t k = 0; k < cache.samples; ++k)
        cache.read(k, points, file);
    return {};
}

/// True for an animation, false for an Error.
bool survives(const std::string& bytes, Read read) {
    try {
        const Animation animation = read(bytes, "some file");
        Points points;
        for (const AnimatedBody& body : animation.bodies)
            for (std::size_t k = 0; k < std::min<std::size_t>(animation.frame_count(), 8); ++k) {
                points_in_frame(body, k, points);
                REQUIRE(points.size() == body.rest.size());
                for (const Tri& t : body.triangles)
                    for (const int v : t)
                        REQUIRE((v >= 0 && static_cast<std::size_t>(v) < points.size()));
                for (const auto& line : body.lines)
                    for (const int v : line)
                        REQUIRE((v >= 0 && static_cast<std::size_t>(v) < points.size()));
                for (const Vec3& p : points)
                    REQUIRE(p.allFinite());
            }
        return true;
    } catch (const Error& error) {
        const std::string message = error.what();
        REQUIRE(message.find('\n') == std::string::npos);
        REQUIRE(message.find("some file") != std::string::npos);
        return false;
    }
}

std::string error_of(const std::string& bytes, Read read = io::read_glb) {
    try {
        read(bytes, "f");
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

} // namespace

TEST_CASE("animations cut off at any byte, and with foreign bytes", "[io][malformed][animation]") {
    std::mt19937 random(20240801);
    const std::vector<std::pair<std::string, Read>> samples{{glb_sample(), io::read_glb},
                                                            {usda_sample(), io::read_usda},
                                                            {cache_sample(true), read_cache},
                                                            {cache_sample(false), read_cache}};
    const std::string foreign[] = {"-1", "1e999", "99999999999", "4294967295", "[", "{", "(",
                                   "\"", "\\",    "null",        "nan",        "0", ":", ","};
    for (const auto& [bytes, read] : samples) {
        CHECK(survives(bytes, read));
        for (std::size_t n = 0; n<bytes.size(); n += bytes.size()> 4000 ? 3 : 1)
            survives(bytes.substr(0, n), read);
        int good = 0, bad = 0;
        for (int round = 0; round < 1500; ++round) {
            std::string damaged = bytes;
            for (int k = 0; k < 1 + round % 3; ++k) {
                const std::size_t at = random() % damaged.size();
                if (random() % 2 == 0)
                    damaged[at] = static_cast<char>(damaged[at] ^ (1 << random() % 8));
                else {
                    const std::string& piece = foreign[random() % std::size(foreign)];
                    damaged.replace(at, std::min(piece.size(), damaged.size() - at), piece);
                }
            }
            survives(damaged, read) ? ++good : ++bad;
        }
        CHECK(bad > 10);
        CHECK(good > 10); // the damage is small enough to get past the first check
    }
}

TEST_CASE("hostile glTF is refused with a reason", "[io][malformed][animation]") {
    CHECK_THAT(error_of("glTF"), Catch::Contains("f, byte 0: the file ends"));
    CHECK_THAT(error_of(glb_of("{}")), Catch::Contains("version not said"));
    CHECK_THAT(error_of(glb_of(std::string(100000, '['))), Catch::Contains("nested too deeply"));
    CHECK_THAT(error_of(glb_of(head + "\"extensionsRequired\":[\"KHR_draco_mesh_compression\"]}")),
               Catch::Contains("KHR_draco_mesh_compression"));
    CHECK_THAT(error_of(glb_of(
                   "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":64,\"uri\":\"../x\"}]}")),
               Catch::Contains("other files"));
    CHECK_THAT(error_of(glb_of(head + "\"nodes\":[{\"children\":[1]},{\"children\":[0]}]}")),
               Catch::Contains("circle"));
    CHECK_THAT(error_of(glb_of(head + "\"nodes\":[{\"children\":[2]},{\"children\":[2]},{}]}")),
               Catch::Contains("two parents"));
    CHECK_THAT(error_of(glb_of(head + "\"nodes\":[{\"mesh\":0}]}")), Catch::Contains("number 0 of meshes"));
    const auto mesh = [](const std::string& accessor, const std::string& view) {
        return glb_of(
            head + "\"bufferViews\":[" + view + "],\"accessors\":[" + accessor +
            "],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"nodes\":[{\"mesh\":0}]}");
    };
    const std::string view = "{\"buffer\":0,\"byteLength\":36}";
    CHECK(error_of(mesh("{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}", view)) ==
          "no error");
    CHECK_THAT(
        error_of(mesh("{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"}", view)),
        Catch::Contains("more than its buffer view"));
    CHECK_THAT(error_of(mesh("{\"componentType\":5126,\"count\":200000000,\"type\":\"VEC3\"}", view)),
               Catch::Contains("again and again")); // zeros without bytes
    CHECK_THAT(
        error_of(
            mesh("{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\",\"byteOffset\":-4}",
                 view)),
        Catch::Contains("offset"));
    CHECK_THAT(
        error_of(
            mesh("{\"bufferView\":0,\"componentType\":5126,\"count\":18446744073709551615,\"type\":\"VEC3\"}",
                 view)),
        Catch::Contains("too large"));
    CHECK_THAT(error_of(mesh("{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}",
                             "{\"buffer\":0,\"byteOffset\":4000000000000000000,\"byteLength\":36}")),
               Catch::Contains("outside"));
    // A mesh of 5000 points that 10000 nodes show.
    std::string nodes = "{\"mesh\":0}";
    for (int i = 1; i < 10000; ++i)
        nodes += ",{\"mesh\":0}";
    CHECK_THAT(
        error_of(glb_of(
            "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":60000}],\"bufferViews\":[{"
            "\"buffer\":0,"
            "\"byteLength\":60000}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":5000,"
            "\"type\":"
            "\"VEC3\"}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"nodes\":[" +
                nodes + "]}",
            std::string(60000, '\0'))),
        Catch::Contains("again and again"));
}

TEST_CASE("A glTF mesh of very many primitives is read quickly, those of one accessor as one body",
          "[io][malformed][animation]") {
    const auto read = [](int primitives) {
        std::string accessors, list;
        for (int i = 0; i < primitives; ++i) {
            accessors += std::string(i > 0 ? "," : "") +
                         R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"})";
            list +=
                std::string(i > 0 ? "," : "") + R"({"attributes":{"POSITION":)" + std::to_string(i) + "}}";
        }
        return io::read_glb(
            glb_of(R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":64}],"bufferViews":)"
                   R"([{"buffer":0,"byteLength":36}],"accessors":[)" +
                   accessors + R"(],"meshes":[{"primitives":[)" + list + "," + list +
                   R"(]}],"nodes":[{"mesh":0}]})"),
            "many.glb");
    };
    const Animation found = read(7);
    REQUIRE(found.bodies.size() == 7);
    CHECK(found.bodies.back().triangles.size() == 2);
    CHECK(growth(4000, [&](int n) { CHECK(read(n).bodies.size() == std::size_t(n)); }) < 9);
}

TEST_CASE("hostile USD text is refused with a reason", "[io][malformed][animation]") {
    const auto error = [](const std::string& text) { return error_of("#usda 1.0\n" + text, io::read_usda); };
    CHECK_THAT(error_of("PXR-USDC", io::read_usda), Catch::Contains("usdcat"));
    CHECK_THAT(error("def Mesh \"m\" { point3f[] points = " + std::string(200, '[')),
               Catch::Contains("nested too deeply"));
    std::string nested;
    for (int i = 0; i < 200; ++i)
        nested += "def Xform \"a\" {";
    CHECK_THAT(error(nested), Catch::Contains("nested too deeply"));
    CHECK_THAT(error("def Xform \"a\" ( references = @../../etc/passwd@ ) {}"),
               Catch::Contains("needs references"));
    CHECK_THAT(error("over \"a\" {}"), Catch::Contains("line 2: got 'over'"));
    CHECK_THAT(error("def Xform \"a\" {}"), Catch::Contains("no mesh"));
    const auto mesh = [&](const std::string& body) { return error("def Mesh \"m\" {\n" + body + "\n}"); };
    CHECK_THAT(mesh("point3f[] points = [(0, 0, 0), (1, 0)]"), Catch::Contains("three a point"));
    CHECK_THAT(mesh("point3f[] points = [(0, 0, nan)]"), Catch::Contains("not finite"));
    CHECK_THAT(mesh("point3f[] points.timeSamples = { 0: [(0,0,0)], 1: [(0,0,0),(0,0,1)] }"),
               Catch::Contains("changes with time"));
    CHECK_THAT(mesh("point3f[] points = [(0, 0, 0)]\nint[] faceVertexCounts = [3]\nint[] faceVertexIndices = "
                    "[0, 0, 7]"),
               Catch::Contains("vertex 7 is out of range"));
    CHECK_THAT(mesh("point3f[] points = [(0, 0, 0)]\nint[] faceVertexCounts = [4]\nint[] faceVertexIndices = "
                    "[0, 0, 0]"),
               Catch::Contains("asks for more"));
    CHECK_THAT(mesh("point3f[] points = [(0, 0, 0)]\nfloat xformOp:foo = 1\nuniform token[] xformOpOrder = "
                    "[\"xformOp:foo\"]"),
               Catch::Contains("xformOp:foo"));
}

TEST_CASE("Very many bodies at very many times are refused before anything is written",
          "[io][malformed][animation]") {
    const TempDir folder;
    std::string text = "#usda 1.0\n";
    constexpr int bodies = 4000;
    for (int i = 0; i < bodies; ++i) {
        const std::string number = std::to_string(i);
        text += "def Mesh \"m" + number + "\" { point3f[] points.timeSamples = { " + number +
                ": [(0,0,0),(1,0,0),(0,1,0)] } int[] faceVertexCounts = [3] int[] faceVertexIndices = "
                "[0,1,2] }\n";
    }
    write_file(folder.path() / "many.usda", text);
    CHECK_THROWS_WITH(
        read_animation(folder.path() / "many.usda"),
        Catch::Contains("many.usda: 4000 bodies at 4000 times; expected at most 10 million shapes"));
    CHECK(read_mesh_data(folder.path() / "many.usda").mesh.triangle_count() ==
          bodies); // its first frame alone
}

TEST_CASE("Point caches refuse coordinates and times that no float holds", "[io][malformed][animation]") {
    const TempDir folder;
    const auto refused = [&](const char* key, const Animation& animation, const std::string& words) {
        const std::string name = std::string("fibres.") + key;
        CHECK_THROWS_WITH(find_animation_format(key)->write(folder.path(), animation, {}, {}),
                          Catch::Contains(name + ": ") && Catch::Contains(words));
        CHECK_FALSE(std::filesystem::exists(folder.path() / name));
    };
    for (const char* key : {"pc2", "mdd"})
        for (const double bad : {1e39, -1e200, 3.41e38}) {
            Animation animation = small();
            animation.bodies[0].points = [bad](std::size_t k, Points& points) {
                points.assign(6, Vec3::Zero());
                if (k == 2)
                    points[5].z() = bad;
            };
            refused(key, animation, "a coordinate is beyond 3402823");
        }
    Animation animation = small();
    animation.seconds.back() = 1e39;
    refused("mdd", animation, "a time is beyond 3402823");
    animation.seconds = {1e9, 1e9 + 1, 1e9 + 2}; // floats lie 64 apart there
    refused("mdd", animation, "is at the time of the one before it");
    // The largest float itself is one.
    animation = small();
    animation.bodies[0].points = [](std::size_t, Points& points) {
        points.assign(6, Vec3::Constant(std::numeric_limits<float>::max()));
    };
    std::ostringstream out;
    CHECK_NOTHROW(io::write_pc2(out, animation.bodies[0], animation, {}, "sample"));
}

TEST_CASE("A series for ParaView names only files below its own folder", "[io][malformed][animation]") {
    const TempDir folder;
    const auto error = [&](const std::string& sets) {
        const std::filesystem::path file = folder.path() / "f.pvd";
        write_file(file, "<VTKFile type=\"Collection\"><Collection>" + sets + "</Collection></VTKFile>");
        try {
            read_animation(file);
        } catch (const Error& e) {
            return std::string(e.what());
        }
        return std::string("no error");
    };
    CHECK_THAT(error("<DataSet timestep=\"0\" file=\"frames/a.vtp\"/>"),
               Catch::Contains("frames/a.vtp: ")); // it is not there
    CHECK_THAT(error("<DataSet timestep=\"0\" file=\"../../etc/passwd\"/>"), Catch::Contains("not below"));
    CHECK_THAT(error("<DataSet timestep=\"0\" file=\"/etc/passwd\"/>"), Catch::Contains("not below"));
    CHECK_THAT(error("<DataSet timestep=\"0\" file=\"a\"/><DataSet timestep=\"0\" file=\"b\"/>"),
               Catch::Contains("not after"));
    CHECK_THAT(error("<DataSet timestep=\"x\" file=\"a\"/>"), Catch::Contains("timestep"));
    CHECK_THAT(error(""), Catch::Contains("no files"));
}
