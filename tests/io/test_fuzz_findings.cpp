// What fuzzing found, one case each (docs/reliability.md). The inputs themselves are in fuzz/corpus.
#include "fascicle/base/error.hpp"
#include "fascicle/io/attachment_file.hpp"
#include "fascicle/io/csv.hpp"
#include "fascicle/io/png.hpp"
#include "fascicle/io/preset_file.hpp"
#include "fascicle/io/project_file.hpp"
#include "fascicle/io/recent_projects.hpp"
#include "fascicle/io/run_reader.hpp"

#include "io/osim_scene/osim_scene.hpp"

#include <catch2/catch.hpp>
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
                      Contains("run/metrics.csv") && Contains("ends too early"));
}

TEST_CASE("A bad parameter or axis of a run names the file", "[io][fuzz]") {
    CHECK_THROWS_WITH(run_of(R"({"vtp_frames":[0],"parameters":{"solver.stiffness":9}})"),
                      Contains("run/summary.json, parameters") && Contains("solver.stiffness"));
    CHECK_THROWS_WITH(run_of(R"({"vtp_frames":[0],"hinge":{"centre":[0,0,0],"axis":[0,0,0]}})"),
                      Contains("run/summary.json") && Contains("no direction"));
}

TEST_CASE("A muscle of a model without a name is a usage error", "[io][fuzz]") {
    for (const char* text : {"", "=", "=pelvis", "mesh=", "mesh=pelvis,", "mesh=,pelvis"})
        CHECK_THROWS_WITH(parse_mesh_of_bodies("--muscle", text),
                          Contains("--muscle") && Contains("MESH=BODY"));
    CHECK(parse_mesh_of_bodies("--muscle", "iliacus_r").bodies.empty());
    CHECK(parse_mesh_of_bodies("--muscle", "a=b.vtk=pelvis,femur_r").mesh == "a=b.vtk");
}
