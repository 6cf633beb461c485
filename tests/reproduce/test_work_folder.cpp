#include "fascicle/base/error.hpp"
#include "fascicle/geometry/primitives.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/solver/soft_body_solver.hpp"
#include "reproduce/run_data.hpp"
#include "reproduce/work_folder.hpp"
#include "support/temp_dir.hpp"

#include <catch2/catch.hpp>
#include <fstream>

using namespace fascicle;
using namespace fascicle::reproduce;
namespace fs = std::filesystem;

namespace {

/// A small box under a plate that comes down a little, 6 frames.
Scene small_scene() {
    Scene scene;
    scene.name = "small";
    Bone plate;
    plate.name = "plate";
    plate.mesh = std::make_shared<TriMesh>(box_mesh(Vec3(-20, 10, -20), Vec3(20, 20, 20), {1, 1, 1}));
    scene.bones.push_back(plate);
    Muscle box;
    box.name = "box";
    box.mesh = std::make_shared<TriMesh>(box_mesh(Vec3(-5, -5, -5), Vec3(5, 9, 5), {3, 3, 3}));
    box.attach_automatically = false;
    scene.muscles.push_back(box);
    scene.timeline = make_shift_timeline(Vec3(0, -2, 0), {2, 2, 2}, 1, 0);
    set_method(scene.parameters, "classic"); // needs no distance grids
    return scene;
}

RunRequest request_of(const Scene& scene, int every = 2) {
    return {std::make_shared<const Scene>(scene), {}, every};
}

fs::file_time_type stamp(const fs::path& folder) {
    return fs::last_write_time(folder / "summary.json");
}

} // namespace

TEST_CASE("reproduce: the key of a run changes with all that its numbers depend on", "[reproduce][unit]") {
    const Scene base = small_scene();
    const std::string key = run_key(request_of(base), "p");
    CHECK(key == run_key(request_of(small_scene()), "p"));
    CHECK(key != run_key(request_of(base), "q"));
    CHECK(key != run_key(request_of(base, 3), "p"));
    const auto changed = [&](const std::function<void(Scene&)>& change) {
        Scene scene = small_scene();
        change(scene);
        return run_key(request_of(scene), "p") != key;
    };
    CHECK(changed([](Scene& s) { s.parameters.set("solver.bending", 0.5); }));
    CHECK(changed([](Scene& s) { set_method(s.parameters, "xpbd"); }));
    CHECK(changed([](Scene& s) { s.timeline = make_shift_timeline(Vec3(0, -2.5, 0), {2, 2, 2}, 1, 0); }));
    CHECK(changed([](Scene& s) { s.timeline.last_frame = 5; }));
    CHECK(changed([](Scene& s) { s.muscles[0].attachments = {{AttachmentKind::origin, 0, {1, 2}}}; }));
    CHECK(changed([](Scene& s) { s.muscles[0].attach_automatically = true; }));
    CHECK(changed([](Scene& s) {
        TriMesh mesh = *s.bones[0].mesh;
        mesh.positions[0].x() += 1e-9;
        s.bones[0].mesh = std::make_shared<TriMesh>(mesh);
    }));
    CHECK(changed([](Scene& s) {
        s.muscles[0].outlines = {{AttachmentKind::origin, "plate", {Vec3(0, 1, 2)}}};
    }));
    CHECK_FALSE(changed([](Scene& s) { s.muscles[0].source.path = "/elsewhere/box.vtk"; }));
}

TEST_CASE("reproduce: a finished run is used again, a damaged one is made again", "[reproduce][unit]") {
    const test::TempDir dir;
    const WorkFolder work(dir.path() / "work", "p", 1);
    const RunRequest request = request_of(small_scene());
    CHECK_FALSE(work.has(request));
    const WorkFolder::Made first = work.ensure(request, {});
    CHECK_FALSE(first.reused);
    REQUIRE(work.has(request));
    const RunData data = read_run(first.folder);
    CHECK(data.frame.size() == 7);
    CHECK(data.frame[3] == 150);
    CHECK(data.method == "classic");
    CHECK(data.metrics.count("solve_ms") == 0);

    const auto made = stamp(first.folder);
    CHECK(work.ensure(request, {}).reused);
    CHECK(stamp(first.folder) == made);

    write_file(first.folder / "frame.png", "a user's own, which is no damage");
    CHECK(work.has(request));

    SECTION("a byte of a table is changed") {
        std::string text = read_file(first.folder / "metrics.csv");
        text[text.size() / 2] = text[text.size() / 2] == '1' ? '2' : '1';
        write_file(first.folder / "metrics.csv", text);
    }
    SECTION("a surface is missing") {
        fs::remove(first.folder / "frames" / "box.0002.vtp");
    }
    SECTION("the list of files is cut off") {
        const std::string text = read_file(first.folder / "run.json");
        write_file(first.folder / "run.json", text.substr(0, text.size() / 2));
    }
    SECTION("the list of files is missing, as after a kill") {
        fs::remove(first.folder / "run.json");
    }
    CHECK_FALSE(work.has(request));
    const WorkFolder::Made again = work.ensure(request, {});
    CHECK_FALSE(again.reused);
    CHECK(work.has(request));
    const RunData remade = read_run(again.folder);
    CHECK(remade.state_hash == data.state_hash);
    CHECK(remade.metrics == data.metrics);
}

TEST_CASE("reproduce: runs of another program are removed, others stay", "[reproduce][unit]") {
    const test::TempDir dir;
    const WorkFolder old_program(dir.path(), "old", 1), work(dir.path(), "new", 1);
    const RunRequest request = request_of(small_scene());
    const fs::path outdated = old_program.ensure(request, {}).folder, kept = work.ensure(request, {}).folder;
    write_file(dir.path() / "mine" / "notes.txt", "a user's own");
    REQUIRE(outdated != kept);
    work.remove_outdated();
    CHECK_FALSE(fs::exists(outdated));
    CHECK(work.has(request));
    CHECK(fs::exists(dir.path() / "mine" / "notes.txt"));
}

TEST_CASE("reproduce: a run that is stopped leaves nothing", "[reproduce][unit]") {
    const test::TempDir dir;
    const WorkFolder work(dir.path() / "work", "p", 1);
    std::atomic<bool> cancel{true};
    JobControl control;
    control.cancel = &cancel;
    CHECK_THROWS_AS(work.ensure(request_of(small_scene()), control), Cancelled);
    std::size_t files = 0;
    if (fs::exists(dir.path() / "work"))
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(dir.path() / "work"))
            files += entry.is_regular_file() ? 1 : 0;
    CHECK(files == 0);
}

TEST_CASE("reproduce: a run that cannot be is an error and leaves no folder", "[reproduce][unit]") {
    const test::TempDir dir;
    const WorkFolder work(dir.path() / "work", "p", 1);
    Scene scene = small_scene();
    // Every vertex is fixed: none is left to move.
    Attachment all{AttachmentKind::origin, 0, {}};
    for (int v = 0; v < scene.muscles[0].mesh->vertex_count(); ++v)
        all.vertices.push_back(v);
    scene.muscles[0].attachments = {all};
    const RunRequest request = request_of(scene);
    CHECK_THROWS_AS(work.ensure(request, {}), Error);
    CHECK_FALSE(fs::exists(work.folder_of(request)));
}
