#include "editor/project_drive.hpp"
#include "fascicle/io/files.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace fascicle;
using namespace fascicle::editor;
using namespace fascicle::test;
using Catch::Matchers::Contains;

TEST_CASE("Save asks for a name once, then writes there, and the undo list stays", "[editor][ui][project]") {
    const TempDir dir;
    Driver d;
    d.frame(3);
    edit(d);
    CHECK(d.document().dirty());
    d.key(key_s, ctrl);
    REQUIRE(d.has("save/name"));
    write_into(d, "save/name", (dir.path() / "first").string());
    d.click("save/save");
    finish(d);
    CHECK_FALSE(popup_open());
    const fs::path file = dir.path() / "first.fascicle";
    CHECK(d.document().path() == file);
    CHECK(title(d) == "first.fascicle");
    CHECK(d.document().history().steps().size() == 2);
    CHECK(read_project_file(file).scene.parameters == d.document().scene().parameters);
    edit(d, 0.6);
    CHECK(title(d) == "first.fascicle *");
    d.key(key_s, ctrl);
    finish(d);
    CHECK_FALSE(popup_open());
    CHECK(title(d) == "first.fascicle");
    CHECK(read_project_file(file).scene.parameters.get("solver.stiffness") == 0.6);
    d.key(key_z, ctrl);
    CHECK(value(d) == 0.4);
    CHECK(title(d) == "first.fascicle *");
    d.key(key_z, {.ctrl = true, .shift = true});
    CHECK(title(d) == "first.fascicle"); // what is saved again
}

TEST_CASE("Save as warns before it replaces a file, and carries meshes inside when told",
          "[editor][ui][project]") {
    const TempDir dir;
    Driver d(scene_with_file(dir.path() / "block.obj"));
    d.frame(3);
    write_file(dir.path() / "there.fascicle", "something else");
    d.key(key_s, ctrl_shift);
    write_into(d, "save/name", (dir.path() / "there.fascicle").string());
    d.key(key_enter); // says that it exists
    REQUIRE(d.has("save/save"));
    CHECK(read_file(dir.path() / "there.fascicle") == "something else");
    d.click("save/cancel");
    CHECK_FALSE(popup_open());
    CHECK(read_file(dir.path() / "there.fascicle") == "something else");
    d.key(key_s, ctrl_shift);
    write_into(d, "save/name", (dir.path() / "there.fascicle").string());
    d.click("save/carry");
    d.click("save/save");
    finish(d);
    CHECK(d.document().path() == dir.path() / "there.fascicle");
    const Project saved = read_project_file(dir.path() / "there.fascicle");
    CHECK(saved.carry_meshes);
    CHECK(saved.scene.bones[0].source.path.empty());
    edit(d);
    d.key(key_s, ctrl); // carried again without being asked
    finish(d);
    CHECK(read_project_file(dir.path() / "there.fascicle").carry_meshes);
}

TEST_CASE("A file that cannot be written is said in plain words and loses nothing", "[editor][ui][project]") {
    const TempDir dir;
    Driver d;
    d.frame(3);
    edit(d);
    write_file(dir.path() / "file", "no folder");
    d.key(key_s, ctrl);
    write_into(d, "save/name", (dir.path() / "file/a.fascicle").string());
    d.click("save/save");
    finish(d);
    REQUIRE(d.has("save/name")); // asks for another name
    CHECK(d.document().dirty());
    CHECK(d.document().path().empty());
    CHECK_THAT(d.editor().log().latest()->text, Contains("cannot"));
    write_into(d, "save/name", (dir.path() / "b.fascicle").string());
    d.click("save/save");
    finish(d);
    CHECK(title(d) == "b.fascicle");
}

TEST_CASE("Unsaved changes ask before quit, new and open: cancel, discard, save", "[editor][ui][project]") {
    const TempDir dir;
    Driver d;
    d.frame(3);
    write_project_file(dir.path() / "other.fascicle", small_scene());
    edit(d);
    SECTION("quit") {
        d.key(key_q, ctrl);
        REQUIRE(d.has("unsaved/save"));
        d.click("unsaved/cancel");
        CHECK_FALSE(d.state().wants_quit);
        CHECK(value(d) == 0.4);
        d.key(key_q, ctrl);
        d.key(key_escape);
        CHECK_FALSE(popup_open());
        CHECK_FALSE(d.state().wants_quit);
        d.key(key_q, ctrl);
        d.click("unsaved/discard");
        CHECK(d.state().wants_quit);
    }
    SECTION("quit after saving under a name") {
        d.key(key_q, ctrl);
        d.click("unsaved/save");
        write_into(d, "save/name", (dir.path() / "kept").string());
        d.click("save/save");
        finish(d);
        CHECK(d.state().wants_quit);
        CHECK(fs::exists(dir.path() / "kept.fascicle"));
    }
    SECTION("the name is not given after all") {
        d.key(key_q, ctrl);
        d.click("unsaved/save");
        d.click("save/cancel");
        finish(d);
        CHECK_FALSE(d.state().wants_quit);
        CHECK(value(d) == 0.4);
    }
    SECTION("new") {
        d.key(key_n, ctrl);
        d.click("unsaved/discard");
        finish(d);
        CHECK(d.document().scene().muscles.empty());
        CHECK(d.state().show_start);
        CHECK_FALSE(d.document().dirty());
        d.key(key_escape); // the empty scene behind it
        CHECK_FALSE(d.state().show_start);
        d.frame(3);
    }
    SECTION("open") {
        d.key(key_o, ctrl);
        REQUIRE(d.has("open_project/open"));
        write_into(d, "browser/path", (dir.path() / "other.fascicle").string());
        d.key(key_enter);
        d.click("open_project/open");
        REQUIRE(d.has("unsaved/discard"));
        d.click("unsaved/discard");
        finish(d);
        CHECK(title(d) == "other.fascicle");
        CHECK(value(d) == small_scene().parameters.get("solver.stiffness"));
    }
    SECTION("dropped on the window") {
        d.editor().drop_files({dir.path() / "other.fascicle"});
        d.frame(2);
        d.click("unsaved/discard");
        finish(d);
        CHECK(title(d) == "other.fascicle");
    }
}

TEST_CASE("Without unsaved changes nothing is asked", "[editor][ui][project]") {
    Driver d;
    d.frame(3);
    d.key(key_n, ctrl);
    finish(d);
    CHECK(d.document().scene().bones.empty());
    d.key(key_q, ctrl);
    CHECK(d.state().wants_quit);
}

TEST_CASE("Unknown fields of a project live through open, edit and save", "[editor][ui][project]") {
    const TempDir dir;
    const fs::path file = dir.path() / "a.fascicle";
    write_project_file(file, small_scene());
    nlohmann::json json = nlohmann::json::parse(read_file(file));
    json["new_top"] = 1;
    json["bones"][1]["new_bone"] = 2;
    write_file(file, json.dump());
    Driver d;
    d.frame(2);
    d.editor().drop_files({file});
    finish(d);
    edit(d);
    d.key(key_s, ctrl);
    finish(d);
    json = nlohmann::json::parse(read_file(file));
    CHECK(json["new_top"] == 1);
    CHECK(json["bones"][1]["new_bone"] == 2);
    CHECK(json["parameters"]["solver.stiffness"] == 0.4);
}

TEST_CASE("A project that cannot be read leaves the scene as it was", "[editor][ui][project]") {
    const TempDir dir;
    write_file(dir.path() / "bad.fascicle", "{ \"fascicle_project\": 99 }");
    Driver d;
    d.frame(2);
    d.editor().drop_files({dir.path() / "bad.fascicle"});
    finish(d);
    CHECK(d.document().scene().name == "small");
    CHECK_THAT(d.editor().log().latest()->text, Contains("version 99 is not known"));
    d.state().show_start = true;
    d.frame(3);
    CHECK(d.has("start/problem"));
}
