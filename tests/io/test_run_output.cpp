#include "fascicle/base/error.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/mesh_file.hpp"
#include "fascicle/io/run_reader.hpp"
#include "fascicle/io/run_writer.hpp"
#include "support/shapes.hpp"
#include "support/temp_dir.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <sstream>

using namespace fascicle;
using namespace fascicle::test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

const std::vector<std::string> columns{"volume_ratio", "edge_extension_mean"};

ScenePtr make_scene() {
    auto scene = std::make_shared<Scene>();
    scene->name = "test";
    scene->bones = {{"hip, right", std::make_shared<const TriMesh>(box()), {}},
                    {"femur", std::make_shared<const TriMesh>(sphere(1, 1)), {}}};
    Muscle strap, other;
    strap.name = "strap";
    strap.mesh = std::make_shared<const TriMesh>(sphere(1.0 / 3.0, 2));
    other.name = "../other";
    other.mesh = std::make_shared<const TriMesh>(box());
    scene->muscles = {strap, other};
    scene->timeline = make_hinge_timeline({Vec3(1, 2, 3), Vec3::UnitX()}, -0.7, Phases{5, 3, 2}, 2, {1});
    return scene;
}

FramePtr make_frame(const Scene& scene, int index) {
    auto frame = std::make_shared<Frame>();
    frame->index = index;
    frame->angle_rad = scene.timeline.angle_rad(index);
    for (int b = 0; b < 2; ++b)
        frame->bone_poses.push_back(scene.timeline.bone_pose(b, index));
    for (const Muscle& muscle : scene.muscles) {
        Points points = muscle.mesh->positions;
        for (Vec3& p : points)
            p += index / 7.0 * Vec3(1, 0.1, 1e-9);
        frame->muscle_positions.push_back(std::make_shared<const Points>(std::move(points)));
    }
    frame->report.solve_seconds = 0.01 * index;
    return frame;
}

/// Runs frames 0..last through a recording and a writer.
std::shared_ptr<Recording> run(const fs::path& folder, int last, RunOutputOptions options,
                               RunState state = RunState::finished) {
    const ScenePtr scene = make_scene();
    auto recording = std::make_shared<Recording>(scene);
    recording->set_attachments(
        {{{AttachmentKind::origin, 0, {0, 2}}, {AttachmentKind::insertion, 1, {5}}}, {}});
    recording->add_note("a note");
    recording->set_prepare_seconds(0.5);
    options.metric_columns = columns;
    options.threads = 2;
    RunWriter writer(folder, scene, options);
    writer.set_attachments(recording->attachments());
    for (int k = 0; k <= last; ++k) {
        recording->append(make_frame(*scene, k));
        writer.add_frame(recording->last_frame(), {{1.0 + k / 3.0, 0.1}, {2.0, 0.2}},
                         {{{"depth", 1, std::vector<double>(66, k)}}, {}});
    }
    recording->finish(state);
    writer.finish(*recording);
    return recording;
}

std::vector<std::string> lines_of(const fs::path& path) {
    std::istringstream text(read_file(path));
    std::vector<std::string> lines;
    for (std::string line; std::getline(text, line);)
        lines.push_back(line);
    return lines;
}

/// Every file of a folder, relative, sorted.
std::vector<std::string> listing(const fs::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file())
            names.push_back(fs::relative(entry.path(), folder).string());
    std::sort(names.begin(), names.end());
    return names;
}

} // namespace

TEST_CASE("a run leaves the files of the contract", "[io][run]") {
    const TempDir dir;
    RunOutputOptions options;
    options.vtp = true;
    options.every = 4;
    const auto recording = run(dir.path() / "new/out", 10, options);
    const fs::path out = dir.path() / "new/out";
    CHECK(listing(out) == std::vector<std::string>{"_.._other.pvd", "bones/femur.vtp", "bones/hip, right.vtp",
                                                   "frames/_.._other.0000.vtp", "frames/_.._other.0004.vtp",
                                                   "frames/_.._other.0008.vtp", "frames/_.._other.0010.vtp",
                                                   "frames/strap.0000.vtp", "frames/strap.0004.vtp",
                                                   "frames/strap.0008.vtp", "frames/strap.0010.vtp",
                                                   "metrics.csv", "motion.csv", "strap.pvd", "summary.json"});

    const auto metrics = lines_of(out / "metrics.csv");
    REQUIRE(metrics.size() == 1 + 2 * 11); // every frame, whatever --every says
    CHECK(metrics[0] == "frame,muscle,angle_deg,volume_ratio,edge_extension_mean");
    CHECK(metrics[1] == "0,strap,0,1,0.1");
    CHECK_THAT(metrics[3], Contains("1,strap,-8.02"));
    const auto motion = lines_of(out / "motion.csv");
    REQUIRE(motion.size() == 1 + 2 * 11);
    CHECK(motion[0] == "frame,bone,m00,m01,m02,m03,m10,m11,m12,m13,m20,m21,m22,m23");
    CHECK(motion[1] == "0,\"hip, right\",1,0,0,0,0,1,0,0,0,0,1,0");

    const auto summary = nlohmann::json::parse(read_file(out / "summary.json"));
    CHECK(summary["scene"] == "test");
    CHECK(summary["method"] == "xpbd");
    CHECK(summary["threads"] == 2);
    CHECK(summary["iterations"] == 10);
    CHECK(summary["frames"] == 10);
    CHECK(summary["prepare_seconds"] == 0.5);
    CHECK(summary["solve_seconds"].get<double>() == Approx(0.55));
    CHECK(summary["fps_median"].get<double>() == Approx(1 / 0.055));
    CHECK(summary["fps_mean"].get<double>() == Approx(10 / 0.55));
    CHECK(summary["state_hash"] == state_hash(*recording->last_frame()));
    CHECK(summary["muscles"][0]["name"] == "strap");
    CHECK(summary["muscles"][0]["vertices"] == 66);
    CHECK(summary["muscles"][0]["triangles"] == 128);
    CHECK(summary["muscles"][0]["attachments"][1]["bone"] == "femur");
    CHECK(summary["parameters"]["solver.method"] == "xpbd");
    CHECK(summary["parameters"]["solver.stiffness"].is_number());
    CHECK(summary["notes"][0] == "a note");
    CHECK(summary["state"] == "finished");

    const MeshFile frame = read_mesh_file(out / "frames/strap.0010.vtp");
    CHECK(frame.mesh.positions == *recording->last_frame()->muscle_positions[0]); // exact
    REQUIRE(frame.point_arrays.size() == 3);
    CHECK(frame.point_arrays[0].name == "attachment");
    CHECK(frame.point_arrays[0].values[2] == 1);
    CHECK(frame.point_arrays[0].values[5] == 2);
    CHECK(frame.point_arrays[2].name == "depth");
    CHECK(frame.point_arrays[2].values[0] == 10);
    CHECK_THAT(read_file(out / "strap.pvd"), Contains("file=\"frames/strap.0008.vtp\""));
}

TEST_CASE("without vtp a run leaves tables only", "[io][run]") {
    const TempDir dir;
    run(dir.path(), 3, {});
    CHECK(listing(dir.path()) == std::vector<std::string>{"metrics.csv", "motion.csv", "summary.json"});
    CHECK_THROWS_WITH(RunReader(dir.path()), Contains("no frames as files"));
}

TEST_CASE("a run read back is the run", "[io][run]") {
    const TempDir dir;
    RunOutputOptions options;
    options.vtp = true;
    options.every = 3;
    const auto recording = run(dir.path(), 10, options, RunState::cancelled);
    CHECK(is_run_folder(dir.path()));
    CHECK_FALSE(is_run_folder(dir.path() / "frames"));
    const RunReader reader(dir.path());
    CHECK(reader.frames() == std::vector<int>{0, 3, 6, 9, 10});
    const Scene& scene = *reader.scene();
    CHECK(scene.name == "test");
    REQUIRE(scene.bones.size() == 2);
    CHECK(scene.bones[1].mesh->triangles == recording->scene().bones[1].mesh->triangles);
    REQUIRE(scene.muscles.size() == 2);
    CHECK(scene.muscles[1].mesh->triangles == recording->scene().muscles[1].mesh->triangles);
    CHECK(scene.timeline.hinge->centre == Vec3(1, 2, 3));
    REQUIRE(reader.attachments()[0].size() == 2);
    CHECK(reader.attachments()[0][0].vertices == std::vector<int>{0, 2});
    CHECK(reader.attachments()[0][1].bone == 1);
    CHECK(reader.attachments()[1].empty());

    const FramePtr frame = reader.read_frame(6), original = recording->frame(6);
    CHECK(frame->index == 6);
    CHECK(frame->angle_rad == Approx(original->angle_rad).epsilon(1e-15));
    CHECK(frame->bone_poses[1].rotation == original->bone_poses[1].rotation);
    CHECK(frame->bone_poses[1].translation == original->bone_poses[1].translation);
    CHECK(*frame->muscle_positions[0] == *original->muscle_positions[0]);
    CHECK_THROWS_WITH(reader.read_frame(7), Contains("frame 7 has no file") && Contains("such as 6"));
    const RecordingPtr again = reader.read_recording();
    CHECK(again->frame_count() == 5);
    CHECK(again->state() == RunState::finished);

    fs::remove(dir.path() / "motion.csv");
    CHECK_THROWS_WITH(RunReader(dir.path()), Contains("motion.csv: cannot read"));
}

TEST_CASE("a run that dies leaves the run before as it was", "[io][run]") {
    const TempDir dir;
    RunOutputOptions options;
    options.vtp = true;
    options.metric_columns = columns;
    {
        const ScenePtr scene = make_scene();
        RunWriter writer(dir.path(), scene, options);
        for (int k = 0; k < 3; ++k)
            writer.add_frame(make_frame(*scene, k), {{1, 2}, {3, 4}});
        // no finish(): an error on the way
    }
    CHECK(fs::is_empty(dir.path()));
    run(dir.path(), 1, options);
    const std::string before = read_file(dir.path() / "frames/strap.0001.vtp");
    {
        const ScenePtr scene = make_scene();
        RunWriter writer(dir.path(), scene, options);
        for (int k = 0; k < 3; ++k)
            writer.add_frame(make_frame(*scene, k), {{1, 2}, {3, 4}});
        CHECK_THROWS_WITH(RunWriter(dir.path(), scene, options), Contains("another program is writing"));
    }
    CHECK(RunReader(dir.path()).frames() == std::vector<int>{0, 1});
    CHECK(read_file(dir.path() / "frames/strap.0001.vtp") == before);
}

TEST_CASE("a shorter run in the same folder leaves nothing of the longer one", "[io][run]") {
    const TempDir dir;
    RunOutputOptions options;
    options.vtp = true;
    run(dir.path(), 6, options);
    write_file(dir.path() / "frames/notes.txt", "mine");
    write_file(dir.path() / "frames/strap.mean.vtp", "mine");
    run(dir.path(), 2, options);
    CHECK_FALSE(fs::exists(dir.path() / "frames/strap.0003.vtp"));
    CHECK(fs::exists(dir.path() / "frames/strap.0002.vtp"));
    CHECK(fs::exists(dir.path() / "frames/notes.txt"));
    CHECK(fs::exists(dir.path() / "frames/strap.mean.vtp"));
    CHECK(RunReader(dir.path()).frames() == std::vector<int>{0, 1, 2});
}

TEST_CASE("what is left out of a run does not stay from the one before", "[io][run]") {
    const TempDir dir;
    RunOutputOptions options;
    options.vtp = true;
    run(dir.path(), 2, options);
    for (const char* old : {"rest.png", "fibres/strap.0000.vtp", "mine.png"})
        write_file(dir.path() / old, "old");
    run(dir.path(), 1, {});
    CHECK(listing(dir.path()) == std::vector<std::string>{"bones/femur.vtp", "bones/hip, right.vtp",
                                                          "metrics.csv", "mine.png", "motion.csv",
                                                          "summary.json"});
}

TEST_CASE("further files of a run come with it, and a run without them is kept", "[io][run]") {
    const TempDir dir;
    const ScenePtr scene = make_scene();
    for (const bool fails : {false, true}) {
        Recording recording(scene);
        RunOutputOptions options;
        options.metric_columns = columns;
        RunWriter writer(dir.path(), scene, options);
        recording.append(make_frame(*scene, 0));
        writer.add_frame(recording.last_frame(), {{1, 2}, {3, 4}});
        recording.finish(RunState::finished);
        const auto more = [&](const fs::path& place) {
            if (fails)
                throw Error("no pictures");
            write_file(place / "rest.png", "picture");
        };
        if (fails)
            CHECK_THROWS_WITH(writer.finish(recording, {}, more), "no pictures");
        else
            CHECK_NOTHROW(writer.finish(recording, {}, more));
        CHECK(is_run_folder(dir.path()));
        CHECK(fs::exists(dir.path() / "rest.png") == !fails);
    }
}

TEST_CASE("inputs are never replaced", "[io][run]") {
    const TempDir dir;
    auto scene = std::make_shared<Scene>(*make_scene());
    for (const char* input : {"out/summary.json", "out/frames/strap.0003.vtp", "out/strap.pvd",
                              "out/bones/femur.vtp", "out/../out/metrics.csv"}) {
        scene->muscles[0].source.path = (dir.path() / input).string();
        try {
            RunWriter writer(dir.path() / "out", scene, {});
            FAIL("no error for " << input);
        } catch (const Error& error) {
            CHECK_THAT(error.what(), Contains("would replace the input"));
            CHECK(error.kind() == ErrorKind::usage);
        }
    }
    scene->muscles[0].source.path = (dir.path() / "out/strap.obj").string();
    CHECK_NOTHROW(RunWriter(dir.path() / "out", scene, {}));
}

TEST_CASE("an output folder that cannot be is one line", "[io][run]") {
    const TempDir dir;
    write_file(dir.path() / "file", "x");
    CHECK_THROWS_WITH(RunWriter(dir.path() / "file", make_scene(), {}), Contains("file"));
    CHECK_THROWS_AS(RunWriter("/dev/null/out", make_scene(), {}), Error);
    CHECK_THROWS_AS(RunWriter("/proc/out", make_scene(), {}), Error);
}

TEST_CASE("a damaged run folder is an Error that names the file", "[io][run]") {
    const TempDir dir;
    RunOutputOptions options;
    options.vtp = true;
    run(dir.path(), 2, options);
    const auto with = [&](const std::string& file, const std::string& from, const std::string& to) {
        const std::string good = read_file(dir.path() / file);
        std::string bad = good;
        const std::size_t at = bad.find(from);
        REQUIRE(at != std::string::npos);
        bad.replace(at, from.size(), to);
        write_file(dir.path() / file, bad);
        CHECK_THROWS_WITH(RunReader(dir.path()).read_recording(),
                          Contains(fs::path(file).filename().string()));
        write_file(dir.path() / file, good);
    };
    CHECK_NOTHROW(RunReader(dir.path()).read_recording());
    with("summary.json", "\"unit\": \"mm\"", "\"unit\": \"inch\"");
    with("summary.json", "\"bones\": [", "\"bones\": 3, \"x\": [");
    with("summary.json", "\"scene\": \"test\"", "\"scene\": 4");
    with("motion.csv", "m00", "mm00");
    with("motion.csv", "femur", "fibula");
    with("metrics.csv", "angle_deg", "angle");
    with("metrics.csv", "\n1,", "\n-1,");
    with("frames/strap.0001.vtp", "</Points>", "</Pints>");
    with("bones/femur.vtp", "VTKFile", "vtkfile");
}
