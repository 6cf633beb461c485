#include "editor/dialogs/dialogs.hpp"
#include "editor/driver.hpp"
#include "editor/features.hpp"
#include "editor/project/project_flow.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/mesh_file.hpp"
#include "fascicle/io/project_file.hpp"
#include "fascicle/io/recent_projects.hpp"
#include "fascicle/scene/embedded_scenes.hpp"
#include "render/imgui_renderer.hpp"
#include "render/offscreen_target.hpp"
#include "render/osmesa_context.hpp"
#include "support/shapes.hpp"
#include "support/temp_dir.hpp"

#include <catch2/catch.hpp>
#include <imgui_internal.h>

using namespace fascicle;
using namespace fascicle::editor;
using namespace fascicle::test;
namespace fs = std::filesystem;

namespace {

struct Start {
    TempDir user;
    Driver d{empty_scene(), 1280, 800, 1, true, user.path()};
    Start() {
        d.state().show_start = true;
        d.frame(3);
    }
    void finish() {
        d.frame();
        d.editor().features().opener.finish();
        d.frame(4);
    }
};

} // namespace

TEST_CASE("The start page without recent projects offers the embedded scenes", "[editor][ui][start]") {
    Start s;
    Driver& d = s.d;
    CHECK(d.has("start/open"));
    CHECK(d.has("start/mesh"));
    CHECK(d.has("start/drop"));
    CHECK_FALSE(d.has("viewport"));
    CHECK_FALSE(d.has("start/back")); // there is nothing to go back to
    for (const EmbeddedSceneInfo& info : embedded_scenes())
        CHECK(d.has("start/scene/" + info.name));
    d.click("start/scene/cylinder");
    s.finish();
    CHECK_FALSE(d.state().show_start);
    CHECK(d.document().scene().embedded_name == "cylinder");
    CHECK(d.has("viewport"));
    d.editor().run(Command::show_start_page);
    d.frame(3);
    REQUIRE(d.has("start/back"));
    d.key(key_delete); // what changes the scene does nothing while it cannot be seen
    CHECK(d.document().scene().bones.size() == 3);
    d.click("start/back");
    CHECK_FALSE(d.state().show_start);
    CHECK(d.document().scene().embedded_name == "cylinder");
}

TEST_CASE("Recent projects open by a click, missing ones say so and can be taken off",
          "[editor][ui][start]") {
    const TempDir dir;
    const fs::path there = dir.path() / "there.fascicle";
    write_project_file(there, small_scene());
    Start s;
    Driver& d = s.d;
    add_recent_project(s.user.path(), {dir.path() / "gone.fascicle", "gone", 1000});
    add_recent_project(s.user.path(), {there, "small", 2000}, PngImage{1, 1, {1, 2, 3, 255}});
    d.state().show_start = false;
    d.frame(2);
    d.state().show_start = true;
    d.frame(3);
    REQUIRE(d.has("start/recent/there.fascicle"));
    REQUIRE(d.has("start/recent/gone.fascicle"));
    CHECK(d.has("start/recent/gone.fascicle/remove"));
    CHECK_FALSE(d.has("start/recent/there.fascicle/remove")); // only under the pointer
    d.click("start/recent/gone.fascicle");
    s.finish();
    CHECK(d.state().show_start);
    CHECK(d.has("start/problem"));
    d.click("start/recent/gone.fascicle/remove");
    d.frame(2);
    CHECK_FALSE(d.has("start/recent/gone.fascicle"));
    CHECK(read_recent_projects(s.user.path()).size() == 1);
    d.click("start/recent/there.fascicle");
    s.finish();
    CHECK_FALSE(d.state().show_start);
    CHECK(d.document().path() == there);
    CHECK_FALSE(d.has("start/problem"));
}

TEST_CASE("Open, empty scene and dropped meshes from the start page", "[editor][ui][start]") {
    Start s;
    Driver& d = s.d;
    SECTION("open") {
        d.click("start/open");
        CHECK(d.has("open_project/open"));
        d.click("open_project/cancel");
        CHECK(d.state().show_start);
    }
    SECTION("Ctrl+O") {
        d.key(key_o, {.ctrl = true});
        CHECK(d.has("open_project/open"));
    }
    SECTION("empty scene") {
        d.click("start/empty");
        CHECK_FALSE(d.state().show_start);
        d.frame(5);
        d.settle();
        CHECK(d.document().scene().bones.empty());
    }
    SECTION("meshes by button") {
        d.click("start/mesh");
        CHECK_FALSE(d.state().show_start);
        CHECK(d.editor().dialogs().mesh.is_open());
    }
    SECTION("a mesh dropped over a scene that is open begins a new one") {
        d.click("start/scene/cylinder");
        s.finish();
        d.state().show_start = true;
        d.frame(2);
        MeshData data;
        data.mesh = box(9, 9, 9);
        write_mesh_file(s.user.path() / "block.obj", data);
        d.editor().drop_files({s.user.path() / "block.obj"});
        d.frame(4);
        CHECK(d.document().scene().bones.empty());
        CHECK(d.editor().dialogs().mesh.is_open());
        d.frame(200); // read
        d.click("mesh/add");
        CHECK(d.document().scene().bones.size() == 1);
    }
}

TEST_CASE("Pictures of the embedded scenes and of recent projects are drawn", "[editor][ui][start]") {
    std::unique_ptr<render::OsmesaContext> gl;
    try {
        gl = std::make_unique<render::OsmesaContext>();
    } catch (const Error&) {
        WARN("skipped: no OSMesa");
        return;
    }
    const TempDir user;
    render::ImguiHost host(1);
    render::ImguiRenderer renderer;
    Editor editor(host, Document(small_scene()), nullptr, {true, true, user.path()});
    editor.use_gl();
    const auto frame = [&](double seconds = 0.1) {
        editor.apply_look();
        renderer.new_frame();
        editor.draw_frame(1280, 800, seconds);
    };
    frame();
    frame();
    const fs::path file = user.path() / "a.fascicle";
    editor.document().mark_saved(file);
    editor.run(Command::save_project);
    frame();
    editor.features().project.finish();
    frame();
    CHECK(fs::exists(file));
    const PngImage picture = read_png(recent_picture(user.path(), file));
    CHECK(picture.width == 320);
    CHECK(picture.height == 200);
    editor.state().show_start = true;
    frame();
    CHECK(editor.features().start.redraw_after());
    for (int i = 0; i < 100 && editor.features().start.redraw_after(); ++i) {
        editor.features().start.wait();
        frame();
    }
    CHECK_FALSE(editor.features().start.redraw_after());
    const render::OffscreenTarget target(1280, 800);
    target.bind();
    renderer.draw(ImGui::GetDrawData());
    target.resolve();
    const render::Image image = target.read_back();
    // Many colours: the pictures are there.
    std::set<std::array<std::uint8_t, 3>> colours;
    for (std::size_t i = 0; i + 3 < image.rgba.size(); i += 4)
        colours.insert({image.rgba[i], image.rgba[i + 1], image.rgba[i + 2]});
    CHECK(colours.size() > 1000);
}
