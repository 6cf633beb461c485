#include "fascicle/io/autosave.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/load_scene.hpp"
#include "fascicle/io/mesh_file.hpp"
#include "fascicle/io/recent_projects.hpp"
#include "fascicle/io/reload_sources.hpp"
#include "support/shapes.hpp"
#include "support/temp_dir.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;
using namespace fascicle::test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

Autosave copy_of(const std::string& name) {
    Scene scene;
    scene.name = name;
    scene.bones.push_back({"block", std::make_shared<const TriMesh>(box(3, 3, 3)), {}});
    PngImage picture{1, 1, {10, 20, 30, 255}};
    return {std::make_shared<const Scene>(scene), "/somewhere/" + name + ".fascicle", {}, picture};
}

std::size_t count_files(const fs::path& folder, const std::string& extension) {
    std::size_t count = 0;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error))
        count += entry.path().extension() == extension ? 1 : 0;
    return count;
}

} // namespace

TEST_CASE("A living session is no crash, one that is gone is", "[io][autosave]") {
    const TempDir user;
    CHECK(crashed_sessions(user.path()).empty());
    CHECK(crashed_sessions({}).empty());
    {
        AutosaveFolder session(user.path());
        for (int i = 0; i < 7; ++i)
            session.write(copy_of("scene " + std::to_string(i)));
        CHECK(count_files(session.folder(), ".fascicle") == 5);
        CHECK(count_files(session.folder(), ".png") == 5);
        CHECK(crashed_sessions(user.path()).empty());
        AutosaveFolder other(user.path());
        other.write(copy_of("other"));
        CHECK(other.folder() != session.folder());
        other.clear();
        CHECK(crashed_sessions(user.path()).empty());
    } // the lock goes as with a process, the copies stay
    const std::vector<AutosaveSession> left = crashed_sessions(user.path());
    REQUIRE(left.size() == 1);
    CHECK(left[0].name == "scene 6");
    CHECK(left[0].project == "/somewhere/scene 6.fascicle");
    CHECK(left[0].copies == 5);
    CHECK(fs::exists(left[0].picture));
    CHECK(read_project_file(left[0].file).scene.name == "scene 6");
    write_file(left[0].folder / "session.json", "{ damaged");
    CHECK(crashed_sessions(user.path()).size() == 1); // the copies tell enough
    remove_autosaves(left[0]);
    CHECK(crashed_sessions(user.path()).empty());
    CHECK_FALSE(fs::exists(left[0].folder));
    fs::create_directories(user.path() / "autosave/empty");
    CHECK(crashed_sessions(user.path()).empty());
    CHECK_FALSE(fs::exists(user.path() / "autosave/empty")); // crashed before its first copy
}

TEST_CASE("Recent projects: the latest first, each once, twelve at most", "[io][recent]") {
    const TempDir user;
    CHECK(read_recent_projects(user.path()).empty());
    for (int i = 0; i < 15; ++i)
        add_recent_project(user.path(), {"/p/" + std::to_string(i) + ".fascicle", "n", i},
                           PngImage{1, 1, {1, 2, 3, 255}});
    add_recent_project(user.path(), {"/p/../p/9.fascicle", "nine", 100});
    const std::vector<RecentProject> list = read_recent_projects(user.path());
    REQUIRE(list.size() == recent_projects_kept);
    CHECK(list[0] == RecentProject{"/p/9.fascicle", "nine", 100});
    CHECK(list[1].path == "/p/14.fascicle");
    CHECK(fs::exists(recent_picture(user.path(), "/p/9.fascicle"))); // kept from before
    CHECK(count_files(user.path() / "pictures", ".png") == recent_projects_kept);
    remove_recent_project(user.path(), "/p/9.fascicle");
    CHECK(read_recent_projects(user.path()).size() == recent_projects_kept - 1);
    CHECK_FALSE(fs::exists(recent_picture(user.path(), "/p/9.fascicle")));
    write_file(user.path() / "recent.json", "[1, 2");
    CHECK(read_recent_projects(user.path()).empty());
    add_recent_project({}, {"/p/1.fascicle", "n", 1}); // nothing is kept without a folder
}

TEST_CASE("Sources that changed are read again, what no longer fits is left out", "[io][reload]") {
    const TempDir dir;
    const auto write = [&](const std::string& name, const TriMesh& mesh) {
        MeshData data;
        data.mesh = mesh;
        write_mesh_file(dir.path() / name, data);
        return dir.path() / name;
    };
    SceneRequest r;
    r.muscles = {write("strap.obj", sphere(30, 2, Vec3(80, 0, 0)))};
    r.bones = {write("block.vtp", box(10, 10, 10))};
    Scene scene = load_scene(r).scene;
    AttachmentArea area;
    area.bone = 0;
    area.vertices = SurfaceRegion(8);
    area.vertices.insert(1);
    scene.muscles[0].areas = {area};
    scene.bones[0].name = "renamed";
    CHECK(scene_sources(scene).size() == 2);
    std::vector<std::string> notes;
    TriMesh moved = box(10, 10, 10);
    moved.positions[0].x() -= 1;
    write("block.vtp", moved);
    Scene again = reload_sources(scene, {(dir.path() / "block.vtp").string()}, notes);
    CHECK(again.bones[0].mesh->positions == moved.positions);
    CHECK(again.bones[0].source.hash != scene.bones[0].source.hash);
    CHECK(again.bones[0].name == "renamed");
    CHECK(again.muscles[0].mesh == scene.muscles[0].mesh);
    CHECK(again.muscles[0].areas.size() == 1);
    CHECK(notes.empty());
    write("block.vtp", sphere(10, 1));
    again = reload_sources(scene, {(dir.path() / "block.vtp").string()}, notes);
    CHECK(again.muscles[0].areas.empty());
    REQUIRE(notes.size() == 1);
    CHECK_THAT(notes[0], Contains("areas on renamed are left out"));
    fs::remove(dir.path() / "block.vtp");
    CHECK_THROWS_WITH(reload_sources(scene, {(dir.path() / "block.vtp").string()}, notes),
                      Contains("cannot read"));
}
