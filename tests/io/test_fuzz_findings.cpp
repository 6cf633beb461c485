// What fuzzing found, one case each (docs/reliability.md). The inputs themselves are in fuzz/corpus.
#include "fascicle/base/error.hpp"
#include "fascicle/geometry/grid_codec.hpp"
#include "fascicle/io/attachment_file.hpp"
#include "fascicle/io/csv.hpp"
#include "fascicle/io/format_registry.hpp"
#include "fascicle/io/osim_file.hpp"
#include "fascicle/io/png.hpp"
#include "fascicle/io/preset_file.hpp"
#include "fascicle/io/project_file.hpp"
#include "fascicle/io/recent_projects.hpp"
#include "fascicle/io/run_reader.hpp"
#include "fascicle/io/storage_write.hpp"

#include "io/formats/usda_read.hpp"
#include "io/formats/usda_write.hpp"
#include "io/osim_scene/osim_scene.hpp"

#include <catch2/catch.hpp>
#include <cstring>
#include <sstream>

using namespace fascicle;
using Catch::Matchers::Contains;

TEST_CASE("A time that no integer holds is no undefined conversion", "[io][fuzz]") {
    const auto time = [](const std::string& number) {
        const auto projects =
            parse_recent_projects(R"({"recent":[{"path":"a","time":)" + number + "}]}", "recent.json");
        REQUIRE(projects.size() == 1);
        return projects[0].time;
    };
    CHECK(time("1700000000") == 1700000000);
    CHECK(time("1e300") == 1'000'000'000'000'000);
    CHECK(time("-1e300") == -1'000'000'000'000'000);
}

TEST_CASE("An outline point that overflows in scene units is an error", "[io][fuzz]") {
    const std::string table = "attachment,bone,x_m,y_m,z_m\norigin,pelvis,1,2,1e308\n";
    CHECK_THROWS_WITH(read_attachments(table, "a.csv", LengthUnit::millimetre),
                      Contains("a.csv, line 2") && Contains("overflows"));
    CHECK(read_attachments(table, "a.csv", LengthUnit::metre)[0].points[0].z() == 1e308);
}

TEST_CASE("Cells with blanks at their ends, and names with separators, are written so that they come back",
          "[io][fuzz]") {
    std::ostringstream out;
    CsvWriter csv(out);
    csv.text("a;b;c;d").text("e\tf").end_row();
    csv.text(" x ").text("").end_row();
    const std::string text = out.str();
    CsvReader reader(text, "a.csv");
    REQUIRE(reader.columns() == std::vector<std::string>{"a;b;c;d", "e\tf"});
    REQUIRE(reader.next_row());
    CHECK(reader.cell(0) == " x ");
}

TEST_CASE("A picture's memory is bounded by what its depth can pack", "[io][fuzz]") {
    const std::vector<std::uint8_t> rgba(std::size_t{4} * 20 * 20, 7);
    std::string bytes = encode_png(20, 20, rgba.data());
    CHECK(decode_png(bytes, "a.png").rgba == rgba);
    bytes.replace(16, 8, std::string("\0\0\x02\0\0\0\x08\0", 8)); // 512 x 2048 pixels of four bytes
    CHECK_THROWS_WITH(decode_png(bytes, "a.png"), Contains("a.png") && Contains("more than its"));
    CHECK_THROWS_WITH(decode_png(bytes.substr(0, 20), "a.png"), Contains("a.png: not a PNG"));
    bytes.replace(12, 4, "CgBI"); // another chunk first: the size would be looked for in the wrong place
    CHECK_THROWS_WITH(decode_png(bytes, "a.png"), Contains("a.png: not a PNG"));
}

TEST_CASE("A picture's chunk that claims more than the file is an error before room is made", "[io][fuzz]") {
    const std::vector<std::uint8_t> rgba(std::size_t{4} * 20 * 20, 7);
    std::string bytes = encode_png(20, 20, rgba.data());
    const std::size_t data = bytes.find("IDAT");
    REQUIRE(data != std::string::npos);
    bytes.replace(data - 4, 4, std::string("\x3f\xff\xff\xff", 4));
    CHECK_THROWS_WITH(decode_png(bytes, "a.png"), Contains("a.png: damaged PNG"));
}

TEST_CASE("A picture that ends with the claim of a large chunk is an error before room is made",
          "[io][fuzz]") {
    const std::vector<std::uint8_t> rgba(std::size_t{4} * 4 * 4, 7);
    std::string bytes = encode_png(4, 4, rgba.data());
    const std::size_t data = bytes.find("IDAT");
    REQUIRE(data != std::string::npos);
    bytes.resize(data + 7); // less than a chunk with its checksum
    bytes.replace(data - 4, 4, std::string("\x31\0\0\x0b", 4));
    CHECK_THROWS_WITH(decode_png(bytes, "a.png"), Contains("a.png: damaged PNG picture (it ends within"));
}

TEST_CASE("A picture may have chunks of data that hold nothing", "[io][fuzz]") {
    const std::vector<std::uint8_t> rgba(std::size_t{4} * 20 * 20, 7);
    std::string bytes = encode_png(20, 20, rgba.data());
    const std::string empty("\0\0\0\0IDAT\x35\xaf\x06\x1e", 12);
    bytes.insert(33, empty); // after the header
    CHECK(decode_png(bytes, "a.png").rgba == rgba);
    CHECK_THROWS_WITH(decode_png(bytes.substr(0, 45), "a.png"),
                      Contains("a.png") && Contains("ends too early"));
}

TEST_CASE("A name that begins with a byte order mark is written so that it comes back", "[io][fuzz]") {
    std::ostringstream out;
    CsvWriter csv(out);
    csv.text("\xef\xbb\xbf"
             "a")
        .text("b")
        .end_row();
    csv.text("\xef\xbb\xbf").integer(1).end_row();
    const std::string text = out.str();
    CsvReader reader(text, "a.csv");
    CHECK(reader.columns() == std::vector<std::string>{"\xef\xbb\xbf"
                                                       "a",
                                                       "b"});
    REQUIRE(reader.next_row());
    CHECK(reader.cell(0) == "\xef\xbb\xbf");
}

TEST_CASE("A table whose only column has blanks in its name is written so that it comes back", "[io][fuzz]") {
    StorageTable table;
    table.columns = {"the only one"};
    table.values = {1, 2};
    table.lines = {1, 2};
    std::ostringstream out;
    write_storage(out, table);
    const StorageTable back = read_storage(out.str(), "a.sto");
    CHECK(back.columns == table.columns);
    CHECK(back.values == table.values);
}

TEST_CASE("A table whose name begins with a byte order mark is written so that it comes back", "[io][fuzz]") {
    StorageTable table;
    table.name = "\xef\xbb\xbfwalk";
    table.columns = {"time"};
    table.values = {1};
    table.lines = {1};
    std::ostringstream out;
    write_storage(out, table);
    CHECK(read_storage(out.str(), "a.sto").name == table.name);
}

TEST_CASE("A distance grid without nodes along one axis alone is none", "[io][fuzz]") {
    std::string bytes = encode_grid(DistanceGrid(TriMesh{}, {}));
    REQUIRE(decode_grid(bytes, 100));
    const std::int32_t rows = 2'000'000'000; // of no nodes: nothing to hold, and two billion to walk over
    std::memcpy(bytes.data() + 12, &rows, sizeof rows);
    CHECK_FALSE(decode_grid(bytes, 100));
}

namespace {

const MeshFormat& format_of(const char* extension) {
    return format_for_writing(std::string("a") + extension);
}

std::string written(const MeshFormat& format, const MeshData& data) {
    std::ostringstream out;
    format.write(out, data);
    return out.str();
}

/// Digits that no float holds.
MeshData triangle_of_thirds() {
    MeshData data;
    data.mesh.positions = {Vec3(1, 1, 1) / 3, Vec3(4, 1e-9, 1) / 3, Vec3(1, 5, -2) / 7, Vec3(8, 8, 8) / 9};
    data.mesh.triangles = {{0, 1, 2}};
    return data;
}

} // namespace

TEST_CASE("Normals in files of floats are of the rounded positions", "[io][fuzz]") {
    for (const char* extension : {".glb", ".usda"}) {
        const MeshFormat& format = format_of(extension);
        const std::string first = written(format, triangle_of_thirds());
        CHECK(written(format, format.read(first, "a")) == first);
    }
}

TEST_CASE("A negative zero in a glTF goes as a positive one, so that it is the same when written again",
          "[io][fuzz]") {
    const MeshFormat& format = format_of(".glb");
    MeshData data;
    data.mesh.positions = {Vec3(0, 0, 0), Vec3(1, -1e-70, 0), Vec3(0, 1, -0.0)};
    data.mesh.triangles = {{0, 1, 2}};
    const std::string first = written(format, data);
    CHECK(written(format, format.read(first, "a")) == first);
}

TEST_CASE("Triangles and lines that are written to a scene and read again do not grow", "[io][fuzz]") {
    for (const char* extension : {".glb", ".usda"}) {
        const MeshFormat& format = format_of(extension);
        MeshData data = triangle_of_thirds();
        data.lines.points = data.mesh.positions;
        data.lines.lines = {{2, 3}, {1, 0, 3}};
        const MeshData back = format.read(written(format, data), "a");
        CHECK(back.mesh.triangles == data.mesh.triangles);
        REQUIRE(back.lines.lines.size() == 2);
        CHECK(back.lines.lines[1].size() == 3);
        const Vec3 last = back.lines.points[static_cast<std::size_t>(back.lines.lines[1][2])];
        CHECK((last - data.lines.points[3]).norm() < 1e-6);
        CHECK(written(format, format.read(written(format, back), "a")) == written(format, back));
    }
}

TEST_CASE("What floats cannot hold, and points alone, are refused by scenes", "[io][fuzz]") {
    for (const char* extension : {".glb", ".usda"}) {
        MeshData data = triangle_of_thirds();
        data.mesh.positions[1].y() = 1e39;
        CHECK_THROWS_WITH(written(format_of(extension), data), Contains("a coordinate is beyond 3402823466"));
        data = triangle_of_thirds();
        data.mesh.triangles.clear();
        CHECK_THROWS_WITH(written(format_of(extension), data), Contains("there is nothing to write"));
    }
}

TEST_CASE("A stage whose scales or times are out of range is an error", "[io][fuzz]") {
    const auto stage = [](const std::string& about, const std::string& times) {
        return io::read_usda(
            "#usda 1.0\n(" + about + ")\ndef BasisCurves \"c\" {\nint[] curveVertexCounts = [1, 0, 2]\n" +
                "point3f[] points.timeSamples = {" + times + "[(9, 9, 9), (0, 0, 0), (1, 0, 0)]}\n}\n",
            "a.usda");
    };
    const Animation sound = stage("metersPerUnit = 1", "0: ");
    REQUIRE(sound.bodies.size() == 1);
    CHECK(sound.bodies[0].lines == std::vector<std::vector<int>>{{1, 2}}); // a curve of one point is none
    CHECK_THROWS_WITH(stage("metersPerUnit = 1e308", "0: "), Contains("a.usda: metersPerUnit is 1e+308"));
    CHECK_THROWS_WITH(stage("timeCodesPerSecond = 1e-320", "0: "), Contains("a.usda: timeCodesPerSecond is"));
    CHECK_THROWS_WITH(stage("timeCodesPerSecond = 0.5", "1e308: "),
                      Contains("a.usda: the times of its samples"));
}

TEST_CASE("Frames that no speed of a stage can tell apart are refused, and slow ones keep their times",
          "[io][fuzz]") {
    const auto rewritten = [](double seconds) {
        Animation animation;
        animation.name = "a";
        animation.frames = {0, 1};
        animation.seconds = {0, seconds};
        AnimatedBody& body = animation.bodies.emplace_back();
        body.triangles = {{0, 1, 2}};
        body.rest = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
        body.poses.resize(2);
        std::ostringstream out;
        io::write_usda(out, animation);
        return io::read_usda(out.str(), "a.usda").seconds;
    };
    CHECK(rewritten(1e7)[1] == Approx(1e7));
    CHECK_THROWS_WITH(rewritten(1e-300), Contains("USD: the unit is") && Contains("from 1e-9 to 1e9"));
}

TEST_CASE("Points that are blended or moved out of range are an error that names the file", "[io][fuzz]") {
    const Animation far = io::read_usda("#usda 1.0\ndef BasisCurves \"c\" {\nint[] curveVertexCounts = [2]\n"
                                        "point3f[] points.timeSamples = {0: [(0, 0, 0), (1e308, 0, 0)], "
                                        "2: [(0, 0, 0), (-1e308, 0, 0)]}\n}\n"
                                        "def BasisCurves \"d\" {\nint[] curveVertexCounts = [2]\n"
                                        "point3f[] points.timeSamples = {1: [(0, 0, 0), (1, 0, 0)]}\n}\n",
                                        "a.usda");
    Points points;
    REQUIRE(far.frame_count() == 3);
    CHECK_NOTHROW(points_in_frame(far.bodies[0], 0, points));
    CHECK_THROWS_WITH(points_in_frame(far.bodies[0], 1, points),
                      Contains("a.usda: point 1 of a body is moved"));
}

TEST_CASE("A preset whose name is no UTF-8 can be written", "[io][fuzz]") {
    Preset preset;
    preset.key = "caf\xe9"; // of a file's name in Latin-1
    preset.label = preset.key;
    preset.values = {{"solver.stiffness", "0.5"}};
    const Preset back = parse_preset(preset_text(preset), "a.json");
    CHECK(back.key == "caf\xef\xbf\xbd");
    CHECK(back.values == preset.values);
}

TEST_CASE("A joint axis whose length is no number has no direction", "[io][fuzz]") {
    const auto project = [](const std::string& axis) {
        return read_project_text(R"({"fascicle_project":2,"timeline":{"hinge":{"centre":[0,0,0],"axis":)" +
                                     axis + "}}}",
                                 "/nowhere/a.fascicle");
    };
    CHECK(project("[0,0,2]").scene.timeline.hinge->axis.z() == 2);
    CHECK_THROWS_WITH(project("[1e-300,0,0]"), Contains("a.fascicle") && Contains("no direction"));
    CHECK_THROWS_WITH(project("[1e300,0,0]"), Contains("no direction"));
}

namespace {

/// A run of no muscles and bones with these files; what is not among them is not there.
RunReader run_of(const std::string& summary, const std::string& metrics = "frame,angle_deg\n0,0\n") {
    const std::string motion = "frame,bone,m00,m01,m02,m03,m10,m11,m12,m13,m20,m21,m22,m23\n";
    return RunReader("run",
                     {[=](const std::filesystem::path& path) {
                          const std::string name = path.filename().string();
                          return name == "summary.json" ? summary : name == "motion.csv" ? motion : metrics;
                      },
                      [](const std::filesystem::path&) { return false; }});
}

} // namespace

TEST_CASE("A run that claims ten million frames makes room for those of its tables", "[io][fuzz]") {
    CHECK(run_of(R"({"vtp_frames":[0]})").frames() == std::vector<int>{0});
    CHECK_THROWS_WITH(run_of(R"({"vtp_frames":[0,10000000]})"),
                      Contains("run/metrics.csv") && Contains("no row of frame 10000000"));
}

TEST_CASE("A bad parameter or axis of a run names the file", "[io][fuzz]") {
    CHECK_THROWS_WITH(run_of(R"({"vtp_frames":[0],"parameters":{"solver.stiffness":9}})"),
                      Contains("run/summary.json, parameters") && Contains("solver.stiffness"));
    CHECK_THROWS_WITH(run_of(R"({"vtp_frames":[0],"hinge":{"centre":[0,0,0],"axis":[0,0,0]}})"),
                      Contains("run/summary.json") && Contains("no direction"));
}

TEST_CASE("A bad parameter of a project names the file once", "[io][fuzz]") {
    const auto error = [](const std::string& parameters) -> std::string {
        try {
            read_project_text(R"({"fascicle_project":2,"parameters":{)" + parameters + "}}",
                              "/nowhere/a.fascicle");
        } catch (const Error& e) {
            return e.what();
        }
        return {};
    };
    CHECK(error(R"("solver.method":"xpbd","solver.stiffness":0.5)").empty());
    CHECK_THAT(error(R"("solver.method":"pbd")"),
               Catch::StartsWith("/nowhere/a.fascicle, parameters: solver.method: bad value 'pbd'"));
    CHECK_THAT(error(R"("solver.stiffness":9)"),
               Catch::StartsWith("/nowhere/a.fascicle, parameters: solver.stiffness: bad value '9'"));
    CHECK_THAT(error(R"("solver.stiffness":[])"), Catch::StartsWith("/nowhere/a.fascicle") &&
                                                      Contains("got array") &&
                                                      !Contains("parameters: /nowhere"));
}

TEST_CASE("A file of a project without a path names the project and the field", "[io][fuzz]") {
    for (const char* field : {R"("line_muscles":{"key":1})", R"("line_muscles":{"path":""})",
                              R"("muscles":[{"name":"m","path":""}])"})
        CHECK_THROWS_WITH(
            read_project_text(R"({"fascicle_project":2,)" + std::string(field) + "}", "/nowhere/a.fascicle"),
            Catch::StartsWith("/nowhere/a.fascicle") && Contains("path") && Contains("missing"));
}

TEST_CASE("A muscle of a model without a name is a usage error", "[io][fuzz]") {
    for (const char* text : {"", "=", "=pelvis", "mesh=", "mesh=pelvis,", "mesh=,pelvis"})
        CHECK_THROWS_WITH(parse_mesh_of_bodies("--muscle", text),
                          Contains("--muscle") && Contains("MESH=BODY"));
    CHECK(parse_mesh_of_bodies("--muscle", "iliacus_r").bodies.empty());
    CHECK(parse_mesh_of_bodies("--muscle", "a=b.vtk=pelvis,femur_r").mesh == "a=b.vtk");
}

TEST_CASE("A wrap object of a model has sizes that can be reckoned with", "[io][fuzz][osim]") {
    const auto read = [](const std::string& object) {
        read_osim("<OpenSimDocument Version=\"40000\"><Model name=\"t\"><Ground "
                  "name=\"ground\"/><BodySet><objects><Body "
                  "name=\"b\"><WrapObjectSet><objects>" +
                      object +
                      "</objects></WrapObjectSet></Body></objects></BodySet></Model></OpenSimDocument>",
                  "a.osim");
    };
    const auto ellipsoid = [](const std::string& radii) {
        return "<WrapEllipsoid name=\"w\"><dimensions>" + radii + "</dimensions></WrapEllipsoid>";
    };
    CHECK_NOTHROW(read(ellipsoid("0.05 0.03 0.01")));
    CHECK_NOTHROW(read(ellipsoid("1e5 1 0.2")));
    for (const char* radii : {"0.1e307 0.1 0.7", "1e308 1e308 1e308", "1e-320 1 1", "1 1e-7 1", "0 1 1"})
        CHECK_THROWS_WITH(read(ellipsoid(radii)), Contains("a.osim") && Contains("'w' has a bad size"));
    CHECK_THROWS_WITH(read("<WrapSphere name=\"w\"><radius>1e300</radius></WrapSphere>"),
                      Contains("has a bad size"));
    CHECK_THROWS_WITH(
        read("<WrapCylinder name=\"w\"><radius>0.1</radius><length>1e300</length></WrapCylinder>"),
        Contains("has a bad size"));
}
