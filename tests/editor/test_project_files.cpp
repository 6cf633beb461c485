#include "editor/project_drive.hpp"
#include "fascicle/io/files.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;
using namespace fascicle::editor;
using namespace fascicle::test;
using Catch::Matchers::Contains;

TEST_CASE("Missing files are asked for, and one found brings those beside it", "[editor][ui][project]") {
    const TempDir dir;
    Scene scene = scene_with_file(dir.path() / "block.obj");
    std::vector<std::string> notes;
    MeshData data;
    data.mesh = box(9, 9, 9);
    write_mesh_file(dir.path() / "second.obj", data);
    scene.bones[1] = load_bone(dir.path() / "second.obj", notes);
    scene.bones[1].name = "turning";
    write_project_file(dir.path() / "a.fascicle", scene);
    fs::create_directories(dir.path() / "moved");
    for (const char* name : {"block.obj", "second.obj"})
        fs::rename(dir.path() / name, dir.path() / "moved" / name);
    Driver d;
    d.frame(2);
    d.editor().drop_files({dir.path() / "a.fascicle"});
    finish(d);
    REQUIRE(d.has("locate/open"));
    CHECK(d.has("locate/file/block.obj"));
    d.click("locate/open"); // nothing found yet: cannot be pressed
    CHECK(d.has("locate/open"));
    d.double_click("browser/moved");
    d.click("browser/block.obj");
    d.click("locate/open");
    finish(d);
    CHECK_FALSE(popup_open());
    CHECK(d.document().scene().bones.size() == 2);
    CHECK(d.document().scene().bones[1].source.path == (dir.path() / "moved/second.obj").string());
    CHECK(title(d) == "a.fascicle *"); // saving writes the new paths
    d.key(key_s, ctrl);
    finish(d);
    CHECK(missing_project_files(dir.path() / "a.fascicle").empty());
    SECTION("cancelled") {
        fs::remove_all(dir.path() / "moved");
        d.editor().drop_files({dir.path() / "a.fascicle"});
        finish(d);
        d.click("locate/cancel");
        CHECK_FALSE(popup_open());
        CHECK(d.document().scene().bones.size() == 2);
    }
}

TEST_CASE("A source that changes on disk is offered again", "[editor][ui][project]") {
    const TempDir dir;
    const fs::path block = dir.path() / "block.obj";
    Driver d(scene_with_file(block));
    d.frame(3);
    const MeshPtr before = d.document().scene().bones[0].mesh;
    MeshData data;
    data.mesh = box(20, 20, 41);
    const auto change = [&] {
        write_mesh_file(block, data);
        fs::last_write_time(block, fs::file_time_type::clock::now() + std::chrono::seconds(5));
        d.editor().features().watch.look();
        d.frame(3);
    };
    change();
    REQUIRE(d.has("reload/reload"));
    SECTION("reload") {
        d.click("reload/reload");
        finish(d);
        CHECK(d.document().scene().bones[0].mesh->positions == data.mesh.positions);
        CHECK(d.document().history().undo_name() == "Reload block.obj");
        d.key(key_z, ctrl);
        CHECK(d.document().scene().bones[0].mesh == before);
    }
    SECTION("keep") {
        d.click("reload/keep");
        finish(d);
        CHECK(d.document().scene().bones[0].mesh == before);
        d.editor().features().watch.look(); // the same change is not offered twice
        d.frame(3);
        CHECK_FALSE(popup_open());
        write_project_file(dir.path() / "a.fascicle", d.document().scene()); // what is here is what is saved
        CHECK(read_project_file(dir.path() / "a.fascicle").scene.bones[0].mesh->positions ==
              before->positions);
    }
    SECTION("broken by the other program") {
        d.click("reload/keep");
        write_file(block, "v 0 0 0\n");
        fs::last_write_time(block, fs::file_time_type::clock::now() + std::chrono::seconds(9));
        d.editor().features().watch.look();
        d.frame(3);
        d.click("reload/reload");
        finish(d);
        CHECK(d.document().scene().bones[0].mesh == before);
        CHECK_THAT(d.editor().log().latest()->text, Contains("block.obj"));
    }
}

TEST_CASE("A project that another program changes can be opened again", "[editor][ui][project]") {
    const TempDir dir;
    const fs::path file = dir.path() / "a.fascicle";
    write_project_file(file, small_scene());
    Driver d;
    d.frame(2);
    d.editor().drop_files({file});
    finish(d);
    edit(d);
    d.key(key_s, ctrl); // our own writing is no change
    finish(d);
    d.editor().features().watch.look();
    d.frame(3);
    CHECK_FALSE(popup_open());
    Scene other = small_scene();
    other.name = "theirs";
    write_project_file(file, other);
    fs::last_write_time(file, fs::file_time_type::clock::now() + std::chrono::seconds(5));
    d.editor().features().watch.look();
    d.frame(3);
    d.click("reload/reload");
    finish(d);
    CHECK(d.document().scene().name == "theirs");
}

TEST_CASE("Copies are kept every minute while there are changes, and go with a clean end",
          "[editor][ui][autosave]") {
    const TempDir user;
    {
        Driver d(small_scene(), 1280, 800, 1, true, user.path());
        d.frame(3);
        d.wait(200);
        finish(d);
        CHECK_FALSE(fs::exists(user.path() / "autosave")); // nothing has changed
        edit(d);
        d.wait(59);
        finish(d);
        CHECK_FALSE(fs::exists(user.path() / "autosave"));
        CHECK(d.editor().features().autosave.redraw_after().value_or(99) < 1.1);
        d.wait(1);
        finish(d);
        const AutosaveFolder* folder = d.editor().features().autosave.folder();
        REQUIRE(folder != nullptr);
        CHECK(read_project_file(folder->folder() / "000001.fascicle")
                  .scene.parameters.get("solver.stiffness") == 0.4);
        d.wait(200);
        finish(d);
        CHECK_FALSE(fs::exists(folder->folder() / "000002.fascicle")); // still the same
        edit(d, 0.5);
        d.wait(60);
        d.wait(1);
        finish(d);
        CHECK(fs::exists(folder->folder() / "000002.fascicle"));
        const fs::path copies = folder->folder();
        SECTION("saved") {
            const TempDir dir;
            d.key(key_s, ctrl);
            write_into(d, "save/name", (dir.path() / "a").string());
            d.click("save/save");
            finish(d);
            CHECK_FALSE(fs::exists(copies));
        }
        SECTION("not wanted") {
            d.key(key_q, ctrl);
            d.click("unsaved/discard");
        }
    }
    CHECK(crashed_sessions(user.path()).empty());
    CHECK(fs::is_empty(user.path() / "autosave"));
}

TEST_CASE("After a crash the next start asks: restore, keep for later, delete", "[editor][ui][autosave]") {
    const TempDir user, dir;
    const fs::path file = dir.path() / "mine.fascicle";
    write_project_file(file, small_scene());
    {
        Driver d(small_scene(), 1280, 800, 1, true, user.path());
        d.frame(2);
        d.editor().drop_files({file});
        finish(d);
        edit(d, 0.7);
        d.wait(1);
        d.wait(61);
        finish(d);
    } // not quit: as a crash leaves it
    REQUIRE(crashed_sessions(user.path()).size() == 1);
    Driver d(small_scene(), 1280, 800, 1, true, user.path());
    d.frame(4);
    REQUIRE(d.has("recovery/0/restore"));
    SECTION("restore") {
        d.click("recovery/0/restore");
        finish(d);
        CHECK(value(d) == 0.7);
        CHECK(title(d) == "mine.fascicle *");
        CHECK(read_project_file(file).scene.parameters.get("solver.stiffness") !=
              0.7); // the file is the user's
        finish(d);
        REQUIRE(d.editor().features().autosave.folder() != nullptr);
        CHECK(fs::exists(d.editor().features().autosave.folder()->folder())); // has a copy of its own at once
        CHECK(crashed_sessions(user.path()).empty());
        d.key(key_s, ctrl);
        finish(d);
        CHECK(read_project_file(file).scene.parameters.get("solver.stiffness") == 0.7);
        CHECK(fs::is_empty(user.path() / "autosave"));
    }
    SECTION("keep for later") {
        d.click("recovery/0/later");
        CHECK_FALSE(popup_open());
        CHECK(crashed_sessions(user.path()).size() == 1);
    }
    SECTION("Esc is later, too") {
        d.key(key_escape);
        CHECK_FALSE(popup_open());
        CHECK(crashed_sessions(user.path()).size() == 1);
    }
    SECTION("delete") {
        d.click("recovery/0/delete");
        CHECK_FALSE(popup_open());
        CHECK(crashed_sessions(user.path()).empty());
    }
    CHECK(fs::exists(file));
}
