// glTF and USD as other programs write them: parts of the formats that our own files do not use.
#include "fascicle/base/error.hpp"
#include "io/formats/gltf_read.hpp"
#include "io/formats/usda_read.hpp"

#include <catch2/catch.hpp>
#include <cstdint>
#include <cstring>

using namespace fascicle;

namespace {

/// Bytes of numbers, one after another.
template <typename Value>
std::string bytes_of(std::initializer_list<Value> values) {
    std::string out;
    for (const Value value : values) {
        char bytes[sizeof(Value)];
        std::memcpy(bytes, &value, sizeof value);
        out.append(bytes, sizeof value);
    }
    return out;
}

std::string glb(std::string json, const std::string& binary) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const auto word = [](std::size_t value) {
        return bytes_of<std::uint32_t>({static_cast<std::uint32_t>(value)});
    };
    return "glTF" + word(2) + word(28 + json.size() + binary.size()) + word(json.size()) + "JSON" + json +
           word(binary.size()) + std::string("BIN\0", 4) + binary;
}

bool same(const Vec3& a, double x, double y, double z) {
    return (a - Vec3(x, y, z)).norm() < 1e-6;
}

} // namespace

TEST_CASE("A glTF with sparse targets, strips, matrices and interleaved numbers is read",
          "[io][animation][unit]") {
    // Four points with stride 16; a strip of two triangles; one sparse target that moves point 2 by (0, 0, 9); weights over two seconds,
    // stepped.
    const std::string points = bytes_of<float>({0, 0, 0, 99, 1, 0, 0, 99, 0, 1, 0, 99, 1, 1, 0, 99});
    const std::string strip = bytes_of<std::uint8_t>({0, 1, 2, 3});
    const std::string place = bytes_of<std::uint16_t>({2, 0}), moved = bytes_of<float>({0, 0, 9});
    const std::string times = bytes_of<float>({0, 1, 2}), weights = bytes_of<float>({0, 1, 0.5f});
    const std::string json = R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":)" +
                             std::to_string(64 + 4 + 4 + 12 + 12 + 12) + R"(}],"bufferViews":[
        {"buffer":0,"byteLength":64,"byteStride":16},{"buffer":0,"byteOffset":64,"byteLength":4},{"buffer":0,"byteOffset":68,"byteLength":2},
        {"buffer":0,"byteOffset":72,"byteLength":12},{"buffer":0,"byteOffset":84,"byteLength":12},{"buffer":0,"byteOffset":96,"byteLength":12}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},{"bufferView":1,"componentType":5121,"count":4,"type":"SCALAR"},
        {"componentType":5126,"count":4,"type":"VEC3","sparse":{"count":1,"indices":{"bufferView":2,"componentType":5123},"values":{"bufferView":3}}},
        {"bufferView":4,"componentType":5126,"count":3,"type":"SCALAR"},{"bufferView":5,"componentType":5126,"count":3,"type":"SCALAR"}],
        "meshes":[{"name":"patch","primitives":[{"attributes":{"POSITION":0},"indices":1,"mode":5,"targets":[{"POSITION":2}]}]}],
        "nodes":[{"children":[1],"matrix":[2,0,0,0, 0,2,0,0, 0,0,2,0, 10,20,30,1]},{"mesh":0,"rotation":[0,0,0.70710678118,0.70710678118]},{"mesh":0}],
        "scenes":[{"nodes":[0]}],"scene":0,
        "animations":[{"samplers":[{"input":3,"output":4,"interpolation":"STEP"}],"channels":[{"sampler":0,"target":{"node":1,"path":"weights"}}]}]})";
    const Animation found = io::read_glb(glb(json, points + strip + place + moved + times + weights), "f");
    REQUIRE(found.bodies.size() == 1); // the third node is not in the scene
    const AnimatedBody& body = found.bodies[0];
    CHECK(body.name == "patch");
    CHECK(body.triangles == std::vector<Tri>{{0, 1, 2}, {1, 3, 2}});
    CHECK(found.seconds == std::vector<double>{0, 1, 2});
    Points then;
    points_in_frame(body, 0, then);
    CHECK(same(then[1], 10, 22, 30)); // a quarter turn about z, twice as large, then moved
    points_in_frame(body, 1, then);
    CHECK(same(then[2], 8, 20, 48));
    points_in_frame(body, 2, then);
    CHECK(same(then[2], 8, 20, 39));
}

TEST_CASE("A glTF with numbers of 16 bits is read with its scale", "[io][animation][unit]") {
    const std::string points = bytes_of<std::int16_t>({0, 0, 0, 0, 32767, 0, 0, 0, 0, -32767, 0, 0});
    const Animation found = io::read_glb(
        glb(R"({"asset":{"version":"2.0"},"extensionsRequired":["KHR_mesh_quantization"],"buffers":[{"byteLength":24}],"bufferViews":[{"buffer":0,
            "byteLength":24,"byteStride":8}],"accessors":[{"bufferView":0,"componentType":5122,"normalized":true,"count":3,"type":"VEC3"}],
            "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0,"scale":[3,3,3]}]})",
            points),
        "f");
    CHECK(found.bodies.at(0).triangles == std::vector<Tri>{{0, 1, 2}});
    CHECK(same(found.bodies[0].rest[1], 3, 0, 0));
    CHECK(same(found.bodies[0].rest[2], 0, -3, 0));
}

TEST_CASE("USD text of other programs is read: polygons, nested transforms, other attributes",
          "[io][animation][unit]") {
    const Animation found = io::read_usda(R"(#usda 1.0
(
    "a comment"
    defaultPrim = "root"
    metersPerUnit = 1
    upAxis = "Z"
    framesPerSecond = 25
    timeCodesPerSecond = 25
    customLayerData = {
        dictionary tool = { string name = "x"; int[] versions = [1, 2] }
    }
)

def Xform "root" ( prepend apiSchemas = ["MotionAPI"] )
{
    matrix4d xformOp:transform = ( (1, 0, 0, 0), (0, 0, 1, 0), (0, -1, 0, 0), (5, 6, 7, 1) )
    uniform token[] xformOpOrder = ["xformOp:transform"]

    def Xform "turn" # a comment
    {
        float3 xformOp:rotateXYZ.timeSamples = {
            0: (0, 0, 0),
            10: (0, 0, 90),
        }
        float3 xformOp:scale = (2, 2, 2)
        uniform token[] xformOpOrder = ["xformOp:rotateXYZ", "xformOp:scale"]
        custom string userProperties:note = "it's \"quoted\" (and) [odd]"
        rel material:binding = </root/mat>

        def Mesh "quad"
        {
            uniform token orientation = "leftHanded"
            int[] faceVertexCounts = [4]
            int[] faceVertexIndices = [0, 1, 2, 3]
            point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
            texCoord2f[] primvars:st = [(0, 0), (1, 0), (1, 1), (0, 1)] (
                interpolation = "faceVarying"
            )
        }
    }
    def Camera "camera" { float focalLength = 50 }
})",
                                          "f");
    REQUIRE(found.bodies.size() == 1);
    CHECK(found.bodies[0].triangles == std::vector<Tri>{{0, 2, 1}, {0, 3, 2}});
    CHECK(found.frames == std::vector<int>{0, 10});
    CHECK(found.seconds[1] == Approx(0.4));
    Points then;
    points_in_frame(found.bodies[0], 0, then);
    CHECK(same(then[1], 7, 6, 7));
    CHECK(same(then[3], 5, 6, 9)); // y becomes z
    points_in_frame(found.bodies[0], 1, then);
    CHECK(same(then[1], 5, 6, 9));
    REQUIRE(found.notes.size() == 1);
    CHECK(found.notes[0].find("Camera") != std::string::npos);
}
