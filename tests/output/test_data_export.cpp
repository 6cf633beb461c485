#include "editor/hand_run.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/io/csv.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/mesh_file.hpp"
#include "fascicle/io/osim_file.hpp"
#include "fascicle/io/run_reader.hpp"
#include "fascicle/simulation/simulation.hpp"
#include "output/data_export.hpp"
#include "support/temp_dir.hpp"

#include <catch2/catch.hpp>
#include <set>

using namespace fascicle;
using namespace fascicle::output;
using fascicle::test::TempDir;
namespace fs = std::filesystem;

namespace {

ExportRequest request(const std::string& kind, const fs::path& target) {
    ExportRequest r;
    r.kind = kind;
    r.target = target;
    return r;
}

} // namespace

TEST_CASE("Chosen frames are those of the range, in steps, and its last", "[output][unit]") {
    const RecordingPtr recording = test::small_recording(11);
    ExportRequest r;
    r.first = 1, r.last = 9, r.step = 3;
    CHECK(chosen_frames(*recording, r) == std::vector<int>{1, 4, 7, 9});
    r.last = 100;
    CHECK(chosen_frames(*recording, r) == std::vector<int>{1, 4, 7, 10});
    r.first = 11;
    CHECK_THROWS_AS(chosen_frames(*recording, r), Error);
    CHECK(place_of_frame(*recording, 10) == 10);
    CHECK_THROWS_AS(place_of_frame(*recording, 11), Error);
}

TEST_CASE("Meshes of every frame: muscles with arrays, bones where they are, series for ParaView",
          "[output][unit]") {
    const TempDir folder;
    const RecordingPtr recording = test::small_recording(5);
    ExportRequest r = request("meshes", folder.path() / "meshes");
    r.last = 4, r.step = 2;
    export_data(r, *recording, {});
    const MeshFile muscle = read_mesh_file(r.target / "muscle_0004.vtp");
    const Points& wanted = *recording->frame(4)->muscle_positions[0];
    REQUIRE(muscle.mesh.positions.size() == wanted.size());
    CHECK((muscle.mesh.positions[7] - wanted[7]).norm() < 1e-4);
    std::set<std::string> arrays;
    for (const NamedArray& array : muscle.point_arrays)
        arrays.insert(array.name);
    CHECK(arrays == std::set<std::string>{"attachment", "depth", "edge_extension"});
    const MeshFile bone = read_mesh_file(r.target / "turning_0004.vtp");
    const Vec3 moved =
        recording->frame(4)->bone_poses[1].apply(recording->scene().bones[1].mesh->positions[7]);
    CHECK((bone.mesh.positions[7] - moved).norm() < 1e-3);
    CHECK(read_file(r.target / "fixed.pvd").find("fixed_0002.vtp") != std::string::npos);
    CHECK(std::distance(fs::directory_iterator(r.target), fs::directory_iterator()) == 3 * 3 + 3);
}

TEST_CASE("The present frame as one OBJ with a group for every body", "[output][unit]") {
    const TempDir folder;
    const RecordingPtr recording = test::small_recording(5);
    ExportRequest r = request("mesh", folder.path() / "now.obj");
    r.frame = 3;
    export_data(r, *recording, {});
    const MeshFile mesh = read_mesh_file(r.target);
    CHECK(mesh.mesh.vertex_count() == 66 + 8 + 8);
    CHECK(mesh.mesh.triangle_count() == 128 + 12 + 12);
    CHECK((mesh.mesh.positions[5] - (*recording->frame(3)->muscle_positions[0])[5]).norm() < 1e-9);
    const std::string text = read_file(r.target);
    CHECK(text.find("o turning\n") != std::string::npos);
    r.frame = 77;
    CHECK_THROWS_AS(export_data(r, *recording, {}), Error);
}

TEST_CASE("Numbers are a plain table with what was run beside it", "[output][unit]") {
    const TempDir folder;
    const RecordingPtr recording = test::small_recording(5);
    const ExportRequest r = request("metrics", folder.path() / "numbers.csv");
    export_data(r, *recording, {});
    const std::string bytes = read_file(r.target);
    CsvReader csv(bytes, "numbers.csv");
    int rows = 0;
    const int volume = csv.column("volume_ratio");
    while (csv.next_row()) {
        CHECK(csv.number(volume) == Approx(1 + 0.002 * rows)); // the sphere is stretched along z
        ++rows;
    }
    CHECK(rows == 5);
    CHECK(read_file(folder.path() / "numbers.json").find("\"method\"") != std::string::npos);
    CHECK(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()) == 2);
}

TEST_CASE("A whole run that was exported can be read again", "[output][unit]") {
    const TempDir folder;
    const RecordingPtr recording = test::small_recording(4);
    recording->add_note("a note");
    const ExportRequest r = request("run", folder.path() / "run");
    export_data(r, *recording, {});
    const RecordingPtr again = RunReader(r.target).read_recording();
    REQUIRE(again->frame_count() == 4);
    CHECK(again->notes() == std::vector<std::string>{"a note"});
    CHECK(again->frame(2)->report.solve_seconds == Approx(0.02));
    CHECK(
        ((*again->frame(3)->muscle_positions[0])[9] - (*recording->frame(3)->muscle_positions[0])[9]).norm() <
        1e-4);
    export_data(r, *test::small_recording(2), {}); // shorter, into the same folder
    CHECK(RunReader(r.target).frames() == std::vector<int>{0, 1});
    CHECK_FALSE(fs::exists(r.target / "frames" / "muscle.0003.vtp"));
}

TEST_CASE("Fibres of a run as polylines and a table, and a run without any says so", "[output][unit]") {
    const TempDir folder;
    const ExportRequest none = request("fibres", folder.path() / "none");
    CHECK_THROWS_WITH(export_data(none, *test::small_recording(3), {}), Catch::Contains("no fibres"));
    CHECK(fs::is_empty(folder.path()));

    Scene scene = test::small_scene();
    Muscle& muscle = scene.muscles[0];
    muscle.attachments = {{AttachmentKind::origin, 0, {}}, {AttachmentKind::insertion, 1, {}}};
    for (int v = 0; v < muscle.mesh->vertex_count(); ++v) {
        const double x = muscle.mesh->positions[static_cast<std::size_t>(v)].x() - 40;
        if (std::abs(x) > 8)
            muscle.attachments[x < 0 ? 0 : 1].vertices.push_back(v);
    }
    scene.timeline.last_frame = 3;
    scene.parameters.set_text("fibres.method", "kukacka");
    scene.parameters.set("fibres.count", 16);
    Recording recording(std::make_shared<const Scene>(scene));
    run_simulation(recording, {1, nullptr}, {});
    REQUIRE(recording.fibres().at(0) != nullptr);
    ExportRequest r = request("fibres", folder.path() / "fibres");
    r.last = 3, r.step = 3;
    export_data(r, recording, {});
    const MeshFile lines = read_mesh_file(r.target / "muscle_fibres_0003.vtp");
    CHECK(lines.lines.lines.size() == static_cast<std::size_t>(recording.fibres()[0]->rest.count));
    const std::string table = read_file(r.target / "fibres.csv");
    CHECK(table.find("moment_arm_mm") != std::string::npos);
    CHECK(fs::exists(r.target / "muscle_fibres.pvd"));

    ExportRequest model = request("osim", folder.path() / "model.osim");
    model.told = std::make_shared<std::vector<std::string>>();
    export_data(model, recording, {});
    CHECK(read_osim_file(model.target).model.muscles.size() ==
          static_cast<std::size_t>(recording.fibres()[0]->rest.count));
    REQUIRE_FALSE(model.told->empty());
    CHECK(model.told->front().starts_with("model.osim: "));
    CHECK(fs::exists(folder.path() / "model_report.json"));
    const std::string with_axes = read_file(folder.path() / "Geometry" / "fixed.vtp");
    model.up = 'y';
    export_data(model, recording, {});
    CHECK(read_file(folder.path() / "Geometry" / "fixed.vtp") != with_axes);
}

TEST_CASE("An export of data that is cancelled leaves nothing", "[output][unit]") {
    const RecordingPtr recording = test::small_recording(6);
    for (const std::string kind : {"meshes", "metrics", "run"}) {
        const TempDir folder;
        std::atomic<bool> stop{false};
        JobControl control;
        control.cancel = &stop;
        control.report = [&](std::string_view, double fraction) { stop = stop || fraction > 0.4; };
        ExportRequest r = request(kind, folder.path() / "x");
        r.last = 5;
        CHECK_THROWS_AS(export_data(r, *recording, control), Cancelled);
        CHECK(fs::is_empty(folder.path()));
    }
}
