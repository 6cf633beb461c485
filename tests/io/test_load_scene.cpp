#include "fascicle/base/error.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/load_scene.hpp"
#include "fascicle/io/mesh_file.hpp"
#include "fascicle/io/project_file.hpp"
#include "support/data_dir.hpp"
#include "support/shapes.hpp"
#include "support/temp_dir.hpp"

#include <catch2/catch.hpp>
#include <random>

using namespace fascicle;
using namespace fascicle::test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

/// A folder with a muscle, a bone that stays, a ball that moves, attachments and fibres.
struct Files {
    TempDir dir;
    Files() {
        write("strap.obj", sphere(30, 2, Vec3(80, 0, 0)));
        write("socket.vtk", inside_out(sphere(11, 3)));
        write("ball.vtp", sphere(10, 3));
        write_file(path("strap.csv"),
                   "attachment,bone,x_mm,y_mm,z_mm\norigin,socket,1,2,3\ninsertion,ball,4,5,6\n");
        write_file(path("fibres.obj"), "v 0 0 0\nv 1 0 0\nv 2 0 0\nl 2 3\nl 1 2\n");
    }
    fs::path path(const std::string& name) const { return dir.path() / name; }
    void write(const std::string& name, const TriMesh& mesh) const {
        MeshData data;
        data.mesh = mesh;
        write_mesh_file(path(name), data);
    }
    SceneRequest request() const {
        SceneRequest r;
        r.muscles = {path("strap.obj")};
        r.bones = {path("socket.vtk")};
        r.moving_bones = {path("ball.vtp")};
        r.hinge = parse_hinge("1,2,3;0,0,2");
        r.angle_deg = -90;
        r.phases = Phases{4, 2, 1};
        r.attachments = {{"strap", path("strap.csv")}};
        r.surface_fibres = {{"strap", path("fibres.obj")}};
        return r;
    }
};

void fails_as_usage(const SceneRequest& request, const std::string& words) {
    try {
        load_scene(request);
        FAIL("no error; expected: " << words);
    } catch (const Error& error) {
        CHECK_THAT(error.what(), Contains(words));
        CHECK(error.kind() == ErrorKind::usage);
    }
}

} // namespace

TEST_CASE("a scene from files", "[io][load_scene]") {
    const Files files;
    const LoadedScene loaded = load_scene(files.request());
    const Scene& scene = loaded.scene;
    CHECK(scene.name == "strap");
    CHECK(scene.unit == LengthUnit::millimetre);
    REQUIRE(scene.bones.size() == 2);
    CHECK(scene.bones[0].name == "socket");
    CHECK(scene.bones[1].name == "ball");
    REQUIRE(scene.muscles.size() == 1);
    const Muscle& strap = scene.muscles[0];
    CHECK(strap.name == "strap");
    CHECK(strap.source.path == files.path("strap.obj").string());
    CHECK(strap.source.hash.size() == 16);
    REQUIRE(strap.outlines.size() == 2);
    CHECK(strap.outlines[1].bone == "ball");
    CHECK(strap.outline_files[0].path == files.path("strap.csv").string());
    REQUIRE(strap.surface_fibres);
    CHECK(strap.surface_fibres->lines == std::vector<std::vector<int>>{{2, 1, 0}});
    CHECK(scene.timeline.last_frame == 7);
    CHECK(scene.timeline.angle_rad(4) == Approx(-M_PI / 2));
    CHECK(scene.timeline.bone_pose(0, 4).is_identity());
    CHECK((scene.timeline.bone_pose(1, 4).apply(Vec3(2, 2, 3)) - Vec3(1, 1, 3)).norm() < 1e-12);
    CHECK_THAT(loaded.notes.at(0), Contains("socket.vtk: 1 part was inside out"));
    CHECK_THAT(loaded.notes.at(1), Contains("socket.vtk: it was inside out as a whole"));
    CHECK_THAT(loaded.notes.at(2), Contains("unit guessed: millimetres"));
}

TEST_CASE("without a hinge the joint centre is fitted", "[io][load_scene]") {
    const Files files;
    SceneRequest r = files.request();
    r.hinge.reset();
    const LoadedScene loaded = load_scene(r);
    REQUIRE(loaded.scene.timeline.hinge);
    CHECK(loaded.scene.timeline.hinge->centre.norm() < 1e-3);
    CHECK(loaded.scene.timeline.hinge->axis == Vec3(1, 0, 0));
    CHECK_THAT(loaded.notes.back(), Contains("joint centre fitted to the ball of ball"));

    r.hinge = parse_hinge(";0,3,0"); // an axis alone
    CHECK(load_scene(r).scene.timeline.hinge->axis == Vec3(0, 1, 0));
    files.write("ball.vtp", box(3, 3, 3));
    files.write("socket.vtk", box(30, 3, 30));
    fails_as_usage(r, "no joint centre can be fitted");
    r.bones.clear();
    fails_as_usage(r, "no joint centre can be fitted (no bone stays)");
}

TEST_CASE("LHDL: the fitted joint centre", "[io][load_scene][data]") {
    FASCICLE_NEED_DATA(data);
    SceneRequest r;
    r.bones = {data / "lhdl/pelvis.obj"};
    r.moving_bones = {data / "lhdl/femur.vtk"};
    const LoadedScene loaded = load_scene(r);
    CHECK((loaded.scene.timeline.hinge->centre - Vec3(143.86, 243.37, -432.53)).norm() < 0.5);
}

TEST_CASE("the unit is guessed from the size of everything", "[io][load_scene]") {
    const Files files;
    SceneRequest r;
    r.muscles = {files.path("small.obj")};
    files.write("small.obj", sphere(0.05, 2));
    CHECK(load_scene(r).scene.unit == LengthUnit::metre);
    r.unit = LengthUnit::millimetre;
    const LoadedScene told = load_scene(r);
    CHECK(told.scene.unit == LengthUnit::millimetre);
    CHECK(told.notes.empty());
}

TEST_CASE("requests that contradict themselves", "[io][load_scene]") {
    const Files files;
    SceneRequest r;
    fails_as_usage(r, "no scene is named");
    r = files.request();
    r.embedded = "cylinder";
    fails_as_usage(r, "more than one scene");
    r = SceneRequest{};
    r.embedded = "cylinder";
    r.angle_deg = 5;
    fails_as_usage(r, "--angle-deg: cannot go with --scene");
    r = SceneRequest{};
    r.embedded = "no such scene";
    fails_as_usage(r, "no such scene");
    r = files.request();
    r.moving_bones.clear();
    fails_as_usage(r, "--angle-deg: there is no bone to turn");
    r = files.request();
    r.attachments[0].first = "starp";
    fails_as_usage(r, "--attachments: there is no muscle 'starp'; expected one of strap");
    r = files.request();
    fs::create_directories(files.path("other"));
    fs::copy_file(files.path("ball.vtp"), files.path("other/socket.vtp"));
    r.moving_bones = {files.path("other/socket.vtp")};
    fails_as_usage(r, "socket: two meshes have this name");
}

TEST_CASE("bad files of a scene are errors that name them", "[io][load_scene]") {
    const Files files;
    const auto fails = [](const SceneRequest& request, const std::string& words) {
        CHECK_THROWS_WITH(load_scene(request), Contains(words));
    };
    SceneRequest r = files.request();
    r.bones = {files.path("none.vtk")};
    fails(r, "none.vtk: cannot read: no such file");
    r = files.request();
    TriMesh open = sphere(30, 2);
    open.triangles.pop_back();
    files.write("strap.obj", open);
    fails(r, "strap.obj: the surface has 1 hole");
    write_file(files.path("strap.obj"), "v 0 0 0\nl 1 1\n");
    fails(r, "strap.obj: has no triangles");
    r = files.request();
    r.muscles.clear();
    r.attachments.clear();
    r.surface_fibres.clear();
    r.bones = {files.path("fibres.obj")};
    fails(r, "fibres.obj: has 0 triangles");
}

TEST_CASE("loading can be cancelled and tells how far it is", "[io][load_scene]") {
    const Files files;
    std::atomic<bool> cancel{false};
    int calls = 0;
    JobControl control;
    control.cancel = &cancel;
    control.report = [&](std::string_view, double fraction) {
        CHECK((fraction >= 0 && fraction <= 1));
        cancel = ++calls == 2;
    };
    CHECK_THROWS_AS(load_scene(files.request(), control), Cancelled);
    CHECK(calls == 2);
}

TEST_CASE("option texts", "[io][load_scene]") {
    const HingeRequest hinge = parse_hinge(" 1, -2.5,3e2 ; 0,0,-4 ");
    CHECK(*hinge.centre == Vec3(1, -2.5, 300));
    CHECK(hinge.axis == Vec3(0, 0, -1));
    CHECK_FALSE(parse_hinge(";1,0,0").centre);
    CHECK(parse_hinge(";1e-99,0,0").axis == Vec3(1, 0, 0));
    for (const char* bad :
         {"", "1,2,3", "1,2,3;", "1,2,3;0,0,0", ";1e-320,0,1e-320", ";1e200,0,0", "1,2;1,0,0",
          "1,2,3;1,0,0;4", "1,2,x;1,0,0", "1,2,nan;1,0,0", "1,2,3;1,0,inf", "1,2,3,4;1,0,0", "1 2 3;1 0 0"})
        CHECK_THROWS_WITH(parse_hinge(bad), Contains("--hinge") && Contains("expected"));
    CHECK(parse_phases("10, 20,0").back == 20);
    for (const char* bad : {"", "1,2", "1,2,3,4", "0,0,0", "-1,2,3", "1.5,2,3", "1000001,1,1", "a,b,c"})
        CHECK_THROWS_WITH(parse_phases(bad), Contains("--phases") && Contains("OUT,BACK,REST"));
    CHECK(parse_unit("m") == LengthUnit::metre);
    CHECK_THROWS_WITH(parse_unit("cm"), Contains("expected mm or m"));
    CHECK(parse_named_file("--attachments", "a=b=c").second == "b=c");
    for (const char* bad : {"", "a", "=b", "a="})
        CHECK_THROWS_WITH(parse_named_file("--attachments", bad), Contains("MUSCLE=FILE"));
}

TEST_CASE("pieces of fibres are joined where exactly two meet", "[io][joined_lines]") {
    const Points p(12, Vec3::Zero());
    using Lines = std::vector<std::vector<int>>;
    const auto join = [&](Lines lines) { return joined_lines({p, std::move(lines)}).lines; };
    CHECK(join({}) == Lines{});
    CHECK(join({{0, 1}, {1, 2}, {2, 3}}) == Lines{{0, 1, 2, 3}});
    CHECK(join({{2, 1}, {2, 3}, {0, 1}}) == Lines{{3, 2, 1, 0}});
    CHECK(join({{0, 1, 2}, {5, 4}, {2, 3}}) == Lines{{0, 1, 2, 3}, {5, 4}});
    CHECK(join({{0, 1}, {1, 2}, {1, 3}}) == Lines{{0, 1}, {1, 2}, {1, 3}}); // a fork
    CHECK(join({{0, 1, 2}, {1, 3}}) == Lines{{0, 1, 2}, {1, 3}});           // an end on the middle of another
    CHECK(join({{0, 1}, {1, 2}, {2, 0}}) == Lines{{0, 1, 2, 0}});           // a ring
    CHECK(join({{4, 4}}) == Lines{{4, 4}});
}

TEST_CASE("LHDL: surface fibres become five polylines", "[io][joined_lines][data]") {
    FASCICLE_NEED_DATA(data);
    Muscle muscle;
    std::vector<std::string> notes;
    load_surface_fibres(muscle, data / "lhdl/gluteus_maximus_surface_fibres.vtk", notes);
    REQUIRE(muscle.surface_fibres->lines.size() == 5);
    for (const auto& line : muscle.surface_fibres->lines)
        CHECK(line.size() == 6);
}

TEST_CASE("a project holds the whole scene", "[io][project]") {
    const Files files;
    LoadedScene loaded = load_scene(files.request());
    Scene& scene = loaded.scene;
    scene.name = "Hüfte";
    scene.parameters.set("solver.stiffness", 0.123456789012345);
    scene.muscles[0].attachments = {{AttachmentKind::origin, 1, {3, 5, 8}}};
    scene.muscles[0].attach_automatically = false;
    fs::create_directories(files.path("projects"));
    const fs::path file = files.path("projects/a.fascicle");
    write_project_file(file, scene);
    CHECK(read_file(file).find("\"../strap.obj\"") != std::string::npos); // relative: the folder may move

    const auto compare = [&](const fs::path& from) {
        SceneRequest r;
        r.project = from;
        const LoadedScene again = load_scene(r);
        const Scene& s = again.scene;
        CHECK(s.name == scene.name);
        CHECK(s.unit == scene.unit);
        REQUIRE(s.bones.size() == 2);
        CHECK(s.bones[1].mesh->positions == scene.bones[1].mesh->positions);
        CHECK(s.bones[1].source.hash == scene.bones[1].source.hash);
        REQUIRE(s.muscles.size() == 1);
        const Muscle &a = s.muscles[0], &b = scene.muscles[0];
        CHECK(a.mesh->positions == b.mesh->positions);
        CHECK(a.outlines.size() == b.outlines.size());
        CHECK(a.outlines[1].points == b.outlines[1].points);
        CHECK(a.surface_fibres->lines == b.surface_fibres->lines);
        CHECK_FALSE(a.attach_automatically);
        REQUIRE(a.attachments.size() == 1);
        CHECK(a.attachments[0].vertices == b.attachments[0].vertices);
        CHECK(a.attachments[0].bone == 1);
        CHECK(s.parameters == scene.parameters);
        CHECK(s.parameters.edited("solver.stiffness"));
        CHECK_FALSE(s.parameters.edited("solver.bending"));
        CHECK(s.timeline.last_frame == scene.timeline.last_frame);
        CHECK(s.timeline.hinge->axis == scene.timeline.hinge->axis);
        for (const double frame : {0.0, 1.5, 4.0, 5.25, 7.0}) {
            CHECK(s.timeline.angle_rad(frame) == scene.timeline.angle_rad(frame));
            CHECK(s.timeline.bone_pose(1, frame).rotation == scene.timeline.bone_pose(1, frame).rotation);
        }
        return again.notes;
    };
    CHECK(compare(file).size() == 2); // the socket is inside out: what was done, and what may be behind it
    const TempDir elsewhere;
    fs::copy(files.dir.path(), elsewhere.path() / "moved", fs::copy_options::recursive);
    compare(elsewhere.path() / "moved/projects/a.fascicle");

    files.write("ball.vtp", sphere(10, 3)); // written anew, the same bytes: no note
    CHECK(compare(file).size() == 2);
}

TEST_CASE("a changed source is a note, a missing one an error", "[io][project]") {
    const Files files;
    const Scene scene = load_scene(files.request()).scene;
    const fs::path file = files.path("a.fascicle");
    write_project_file(file, scene);
    files.write("ball.vtp", sphere(9, 3));
    std::string all;
    for (const std::string& note : read_project_file(file).notes)
        all += note + "\n";
    CHECK_THAT(all, Contains("ball.vtp: not the file that the project was saved with"));
    fs::remove(files.path("ball.vtp"));
    CHECK_THROWS_WITH(read_project_file(file), Contains("ball.vtp: cannot read"));
}

TEST_CASE("fields of newer versions survive", "[io][project]") {
    const Files files;
    const Scene scene = load_scene(files.request()).scene;
    const fs::path file = files.path("a.fascicle");
    write_project_file(file, scene);
    std::string text = read_file(file);
    text.replace(text.find("\"unit\""), 0, "\"camera\": {\"zoom\": 2},\n  ");
    text.replace(text.find("\"name\": \"ball\""), 0, "\"colour\": \"ivory\", ");
    text.replace(text.find("\"solver.method\""), 0, "\"future.key\": 7, ");
    write_file(file, text);
    const Project project = read_project_file(file);
    std::string notes;
    for (const std::string& note : project.notes)
        notes += note;
    CHECK_THAT(notes, Contains("parameter future.key is not known"));
    write_project_file(file, project.scene, project.text);
    const std::string again = read_file(file);
    CHECK_THAT(again,
               Contains("\"zoom\": 2") && Contains("\"colour\": \"ivory\"") && Contains("\"future.key\": 7"));
}

TEST_CASE("a project of an embedded scene", "[io][project]") {
    const TempDir dir;
    SceneRequest r;
    r.embedded = "squish-box";
    Scene scene = load_scene(r).scene;
    REQUIRE_FALSE(scene.bones.empty());
    scene.bones[0].name = "renamed";
    write_project_file(dir.path() / "a.fascicle", scene);
    const Scene again = read_project_file(dir.path() / "a.fascicle").scene;
    CHECK(again.embedded_name == "squish-box");
    REQUIRE(again.bones.size() == scene.bones.size());
    CHECK(again.bones[0].name == "renamed");
    CHECK(again.bones[0].mesh->positions == scene.bones[0].mesh->positions);
    CHECK(again.muscles[0].mesh->positions == scene.muscles[0].mesh->positions);
    CHECK(again.timeline.last_frame == scene.timeline.last_frame);

    scene.embedded_name.clear(); // then they come from nowhere and are carried
    write_project_file(dir.path() / "b.fascicle", scene);
    CHECK(read_project_file(dir.path() / "b.fascicle").scene.bones[0].mesh->positions ==
          scene.bones[0].mesh->positions);
}

TEST_CASE("damaged projects end in a scene or an Error of one line", "[io][project]") {
    const Files files;
    SceneRequest r = files.request();
    Scene scene = load_scene(r).scene;
    scene.muscles[0].attachments = {{AttachmentKind::origin, 1, {3, 5, 8}}};
    const fs::path file = files.path("a.fascicle");
    write_project_file(file, scene);
    const std::string good = read_file(file);
    std::mt19937 random(9);
    const std::string foreign[] = {"null", "-1", "1e999", "[]", "{}", "\"x\"", "99999999999", "[[[[", "true"};
    for (int round = 0; round < 300; ++round) {
        std::string text = good;
        const std::size_t at = random() % text.size();
        switch (random() % 4) {
        case 0:
            text.resize(at);
            break;
        case 1:
            text[at] = static_cast<char>(random());
            break;
        case 2: { // another value for a field
            const std::size_t colon = text.find(": ", at);
            if (colon != std::string::npos)
                text.replace(colon + 2, text.find_first_of(",\n", colon + 2) - colon - 2,
                             foreign[random() % std::size(foreign)]);
            break;
        }
        default:
            text.erase(at, random() % 30);
        }
        write_file(file, text);
        try {
            read_project_file(file);
        } catch (const Error& error) {
            REQUIRE(std::string(error.what()).find('\n') == std::string::npos);
        }
    }
    write_file(file, "{}");
    CHECK_THROWS_WITH(read_project_file(file), Contains("not a project file"));
    write_file(file, "{\"fascicle_project\": 3}");
    CHECK_THROWS_WITH(read_project_file(file), Contains("project version 3 is not known"));
    write_file(file, "{\n\n\"fascicle_project\": }");
    CHECK_THROWS_WITH(read_project_file(file), Contains("a.fascicle, line 3: not valid JSON"));
    write_file(file, std::string(200000, '['));
    CHECK_THROWS_WITH(read_project_file(file), Contains("nested too deeply"));
}
