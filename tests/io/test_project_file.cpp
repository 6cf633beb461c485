#include "fascicle/base/error.hpp"
#include "fascicle/base/state_hash.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/mesh_file.hpp"
#include "fascicle/io/project_file.hpp"
#include "fascicle/scene/embedded_scenes.hpp"
#include "fascicle/simulation/simulation.hpp"
#include "support/json_schema.hpp"
#include "support/shapes.hpp"
#include "support/temp_dir.hpp"

#include <catch2/catch.hpp>
#include <sys/stat.h>
#include <unistd.h>

using namespace fascicle;
using namespace fascicle::test;
using Catch::Matchers::Contains;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

const fs::path source_dir = FASCICLE_SOURCE_DIR;

std::string schema_fault_of(const fs::path& file) {
    static const json schema = json::parse(read_file(source_dir / "resources/project.schema.json"));
    return schema_fault(json::parse(read_file(file)), schema, schema);
}

/// A muscle and a moving bone from files, and everything that a project can say about them.
struct Files {
    TempDir dir;
    Scene scene;
    Files() {
        write("strap.obj", sphere(30, 2, Vec3(80, 0, 0)));
        write("ball.vtp", sphere(10, 2));
        SceneRequest r;
        r.muscles = {path("strap.obj")};
        r.bones = {};
        r.moving_bones = {path("ball.vtp")};
        r.hinge = parse_hinge("1,2,3;0,0,2");
        r.angle_deg = -40;
        r.phases = Phases{4, 2, 1};
        scene = load_scene(r).scene;
        Muscle& strap = scene.muscles[0];
        strap.surface_fibres =
            std::make_shared<const Polylines>(Polylines{{Vec3(0.1, 1e-300, 3), Vec3(1, 2, 3)}, {{1, 0}}});
        strap.fibre_template = std::make_shared<const FibreTemplate>(parallel_template());
        strap.outlines = {
            {AttachmentKind::insertion, "ball", {Vec3(1, 2, 3), Vec3(0.1, 0.2, 0.3)}, "long", true}};
        AttachmentArea area;
        area.kind = AttachmentKind::insertion;
        area.bone = 0;
        area.vertices = SurfaceRegion(scene.bones[0].mesh->vertex_count());
        for (const int v : {0, 1, 2, 9})
            area.vertices.insert(v);
        strap.areas = {area};
        scene.markers = {{0, "rest"}, {4, "flexed"}};
    }
    fs::path path(const std::string& name) const { return dir.path() / name; }
    void write(const std::string& name, const TriMesh& mesh) const {
        MeshData data;
        data.mesh = mesh;
        write_mesh_file(path(name), data);
    }
};

void check_same(const Scene& a, const Scene& b) {
    CHECK(a.name == b.name);
    CHECK(a.unit == b.unit);
    CHECK(a.markers == b.markers);
    CHECK(a.parameters == b.parameters);
    CHECK(a.timeline.last_frame == b.timeline.last_frame);
    REQUIRE(a.bones.size() == b.bones.size());
    REQUIRE(a.muscles.size() == b.muscles.size());
    for (std::size_t i = 0; i < a.bones.size(); ++i) {
        CHECK(a.bones[i].name == b.bones[i].name);
        CHECK(a.bones[i].mesh->positions == b.bones[i].mesh->positions);
        CHECK(a.bones[i].mesh->triangles == b.bones[i].mesh->triangles);
    }
    for (std::size_t i = 0; i < a.muscles.size(); ++i) {
        const Muscle &x = a.muscles[i], &y = b.muscles[i];
        CHECK(x.mesh->positions == y.mesh->positions);
        CHECK(x.mesh->triangles == y.mesh->triangles);
        CHECK(x.areas == y.areas);
        CHECK(x.attach_automatically == y.attach_automatically);
        REQUIRE(x.attachments.size() == y.attachments.size());
        for (std::size_t k = 0; k < x.attachments.size(); ++k)
            CHECK(x.attachments[k].vertices == y.attachments[k].vertices);
        REQUIRE(x.outlines.size() == y.outlines.size());
        for (std::size_t k = 0; k < x.outlines.size(); ++k)
            CHECK(x.outlines[k].points == y.outlines[k].points);
        REQUIRE((x.surface_fibres == nullptr) == (y.surface_fibres == nullptr));
        if (x.surface_fibres) {
            CHECK(x.surface_fibres->points == y.surface_fibres->points);
            CHECK(x.surface_fibres->lines == y.surface_fibres->lines);
        }
        REQUIRE((x.fibre_template == nullptr) == (y.fibre_template == nullptr));
        if (x.fibre_template)
            CHECK(x.fibre_template->point(0.2, 0.3, 0.4) == y.fibre_template->point(0.2, 0.3, 0.4));
    }
}

std::string state_of(const Scene& scene) {
    Recording recording(std::make_shared<const Scene>(scene));
    run_simulation(recording, {1, nullptr}, {});
    StateHash hash;
    for (const PointsPtr& points : recording.frame(recording.frame_count() - 1)->muscle_positions)
        hash.add_points(*points);
    return hash.hex();
}

} // namespace

TEST_CASE("A project holds markers, fibres, a template and areas, and satisfies the schema",
          "[io][project]") {
    const Files files;
    const fs::path file = files.path("a.fascicle");
    write_project_file(file, files.scene);
    CHECK(schema_fault_of(file) == "");
    CHECK(read_file(file).find("\"mesh\"") == std::string::npos); // both are named by path
    const Project again = read_project_file(file);
    check_same(again.scene, files.scene);
    CHECK_FALSE(again.carry_meshes);
    json broken = json::parse(read_file(file));
    broken["markers"][0]["frame"] = -1;
    write_file(files.path("b.fascicle"), broken.dump());
    CHECK(schema_fault_of(files.path("b.fascicle")) == "$.markers[0].frame: minimum");
    CHECK_THROWS_WITH(read_project_file(files.path("b.fascicle")), Contains("markers[0].frame"));
}

TEST_CASE("A project with its meshes inside needs no other file and gives the same numbers",
          "[io][project]") {
    const Files files;
    const TempDir other;
    const fs::path file = other.path() / "alone.fascicle";
    write_project_file(file, files.scene, ProjectSaving{{}, true});
    CHECK(schema_fault_of(file) == "");
    fs::remove(files.path("strap.obj"));
    fs::remove(files.path("ball.vtp"));
    CHECK(missing_project_files(file).empty());
    const Project again = read_project_file(file);
    check_same(again.scene, files.scene);
    CHECK(again.carry_meshes);
    CHECK(state_of(again.scene) == state_of(files.scene));
    write_project_file(file, again.scene); // comes from no file now: carried again
    check_same(read_project_file(file).scene, files.scene);
}

TEST_CASE("What comes from no file, or is no longer in it, is carried", "[io][project]") {
    Files files;
    const fs::path file = files.path("a.fascicle");
    SECTION("scaled when it was added") {
        auto mesh = std::make_shared<TriMesh>(*files.scene.bones[0].mesh);
        for (Vec3& p : mesh->positions)
            p *= 1.0 / 3;
        files.scene.bones[0].mesh = mesh;
        files.scene.bones[0].source.hash.clear();
    }
    SECTION("made") {
        files.scene.bones[0].source = {};
    }
    SECTION("changed on disk since") {
        files.write("ball.vtp", sphere(9, 2));
    }
    SECTION("in an embedded scene, but no mesh of it") {
        files.scene.embedded_name = "cylinder";
        files.scene.bones[0].source = {};
    }
    write_project_file(file, files.scene);
    CHECK(schema_fault_of(file) == "");
    check_same(read_project_file(file).scene, files.scene);
}

TEST_CASE("Every embedded scene comes back from its project", "[io][project][slow]") {
    const TempDir dir;
    for (const char* name : {"cylinder", "squish-box", "two-heads"}) {
        INFO(name);
        const Scene scene = make_embedded_scene(name);
        const fs::path file = dir.path() / (std::string(name) + ".fascicle");
        write_project_file(file, scene);
        CHECK(schema_fault_of(file) == "");
        const Scene again = read_project_file(file).scene;
        check_same(again, scene);
        for (const ParamRow& row : scene.parameters.table().rows())
            if (row.kind != ParamKind::choice)
                CHECK(again.parameters.default_value(row.key) == scene.parameters.default_value(row.key));
        Scene other =
            scene; // with another method in force the file does not have them; the embedded scene has
        set_method(other.parameters, "classic");
        write_project_file(file, other);
        ParamSet back = read_project_file(file).scene.parameters;
        CHECK(back.get_choice("solver.method") == "classic");
        set_method(back, "xpbd");
        for (const ParamRow& row : scene.parameters.table().rows())
            if (row.kind != ParamKind::choice)
                CHECK(back.default_value(row.key) == scene.parameters.default_value(row.key));
    }
}

TEST_CASE("A project of version 1 opens", "[io][project]") {
    const Project project = read_project_file(source_dir / "tests/resources/version_1.fascicle");
    const Scene& scene = project.scene;
    CHECK(project.notes.empty());
    CHECK(scene.name == "Cylinder of version 1");
    CHECK(scene.parameters.get("solver.bending") == 0.25);
    CHECK(scene.parameters.get("solver.stiffness") ==
          0.3); // the scene's own default, which version 1 did not write
    REQUIRE(scene.bones.size() == 4);
    CHECK(scene.bones[3].name == "block");
    CHECK(scene.bones[3].mesh->vertex_count() == 8);
    CHECK(scene.muscles[0].areas.at(0).vertices.size() == 4);
    CHECK(scene.muscles[0].attachments.size() ==
          make_embedded_scene("cylinder").muscles[0].attachments.size());
    CHECK(scene.timeline.angle_rad(100) == 0.8);
}

TEST_CASE("Unknown fields are kept at every level, whatever moves or is renamed", "[io][project]") {
    Files files;
    const fs::path file = files.path("a.fascicle");
    write_project_file(file, files.scene);
    json j = json::parse(read_file(file));
    j["new_top"] = {{"deep", {1, 2}}};
    j["bones"][0]["new_bone"] = "ivory";
    j["muscles"][0]["new_muscle"] = true;
    j["muscles"][0]["areas"][0]["new_area"] = 1;
    j["muscles"][0]["outlines"][0]["new_outline"] = 2;
    j["timeline"]["new_timeline"] = 3;
    j["timeline"]["hinge"]["new_hinge"] = 4;
    j["timeline"]["tracks"][0]["new_track"] = 5;
    j["timeline"]["tracks"][0]["keys"][1]["new_key"] = 6;
    j["timeline"]["angles"][1]["new_angle"] = 7;
    j["markers"][1]["new_marker"] = 8;
    j["parameters"]["new.parameter"] = 9;
    write_file(file, j.dump());
    const Project project = read_project_file(file);
    Scene edited = project.scene;
    edited.bones[0].name = "head"; // found again by its file
    edited.markers.insert(edited.markers.begin() + 1, {2, "between"});
    edited.markers[2].frame = 5; // found again by its name
    write_project_file(file, edited, project.text);
    const json again = json::parse(read_file(file));
    CHECK(again["new_top"] == j["new_top"]);
    CHECK(again["bones"][0]["new_bone"] == "ivory");
    CHECK(again["bones"][0]["name"] == "head");
    CHECK(again["muscles"][0]["new_muscle"] == true);
    CHECK(again["muscles"][0]["outlines"][0]["new_outline"] == 2);
    CHECK(again["timeline"]["new_timeline"] == 3);
    CHECK(again["timeline"]["hinge"]["new_hinge"] == 4);
    CHECK(again["timeline"]["angles"][1]["new_angle"] == 7);
    CHECK(again["markers"][2]["new_marker"] == 8);
    CHECK(again["parameters"]["new.parameter"] == 9);
    CHECK(schema_fault_of(file) == "");
    // A field that is known and gone stays gone.
    edited.markers.clear();
    edited.muscles[0].areas.clear();
    write_project_file(file, edited, project.text);
    CHECK_FALSE(json::parse(read_file(file)).contains("markers"));
    CHECK_FALSE(json::parse(read_file(file))["muscles"][0].contains("areas"));
    // Same names again: also what hung on them.
    write_project_file(file, project.scene, project.text);
    const json third = json::parse(read_file(file));
    CHECK(third["muscles"][0]["areas"][0]["new_area"] == 1);
    CHECK(third["timeline"]["tracks"][0]["new_track"] == 5);
    CHECK(third["timeline"]["tracks"][0]["keys"][1]["new_key"] == 6);
}

TEST_CASE("Missing files of a project are told, and read where they are now", "[io][project]") {
    const Files files;
    const fs::path file = files.path("a.fascicle");
    write_project_file(file, files.scene);
    CHECK(missing_project_files(file).empty());
    fs::create_directories(files.path("moved"));
    fs::rename(files.path("ball.vtp"), files.path("moved/caput.vtp"));
    const std::vector<MissingFile> missing = missing_project_files(file);
    REQUIRE(missing.size() == 1);
    CHECK(missing[0].path == files.path("ball.vtp"));
    CHECK(missing[0].what == "bone ball");
    CHECK(missing[0].hash == files.scene.bones[0].source.hash);
    CHECK_THROWS_WITH(read_project_file(file), Contains("ball.vtp: cannot read"));
    const LocatedFiles located{{missing[0].path, files.path("moved/caput.vtp")}};
    CHECK(missing_project_files(file, located).empty());
    const Project found = read_project_file(file, 1, {}, located);
    check_same(found.scene, files.scene);
    CHECK(found.scene.bones[0].source.path == files.path("moved/caput.vtp").string());
}

TEST_CASE("Carried meshes whose sizes lie are errors before anything is allocated", "[io][project]") {
    const Files files;
    const fs::path file = files.path("a.fascicle");
    write_project_file(file, files.scene, ProjectSaving{{}, true});
    const json good = json::parse(read_file(file));
    const auto fails = [&](const char* key, const json& value, const std::string& words) {
        json bad = good;
        bad["bones"][0]["mesh"][key] = value;
        write_file(file, bad.dump());
        CHECK_THROWS_WITH(read_project_file(file), Contains("bones[0].mesh") && Contains(words));
    };
    fails("vertices", 99999999, "data");
    fails("vertices", 2000000000, "vertices");
    fails("vertices", -1, "vertices");
    fails("triangles", 1e300, "triangles");
    fails("coordinate_bits", 16, "32 or 64");
    fails("index_bits", 32, "data");
    fails("data", "", "data");
    fails("data", nullptr, "data");
    std::string text = good["bones"][0]["mesh"]["data"];
    text[4] = '!';
    fails("data", text, "is no such text");
    text = good["bones"][0]["mesh"]["data"];
    text.replace(text.size() - 40, 36, std::string(36, '/')); // indices of 65535
    fails("data", text, "vertex that is not there");
    text.replace(0, 16, std::string(16, '/')); // NaN
    fails("data", text, "no number");
    json open = good;
    const json mesh = open["bones"][0]["mesh"];
    open["muscles"][0]["mesh"]["triangles"] = mesh["triangles"].get<int>() - 1;
    write_file(file, open.dump());
    CHECK_THROWS_AS(read_project_file(file), Error);
}

TEST_CASE("Saving a document replaces what a link points to and keeps its permissions", "[io][files]") {
    const TempDir dir;
    const fs::path real = dir.path() / "real.fascicle", link = dir.path() / "link.fascicle";
    write_file(real, "old");
    ::chmod(real.c_str(), 0640);
    fs::create_symlink("real.fascicle", link);
    const fs::path orphan = dir.path() / "real.fascicle.part999999999-0";
    const fs::path foreign = dir.path() / ("real.fascicle.part" + std::to_string(::getpid()) + "-77");
    write_file(orphan, "half");
    write_file(foreign, "of a program that runs");
    write_document(link, "new");
    CHECK(fs::is_symlink(link));
    CHECK(read_file(real) == "new");
    CHECK((fs::status(real).permissions() & fs::perms::all) == fs::perms(0640));
    CHECK_FALSE(fs::exists(orphan));
    CHECK(fs::exists(foreign));
    CHECK_THROWS_WITH(write_document(dir.path(), "x"), Contains("is a folder"));
    if (::geteuid() != 0) { // root may write anything
        ::chmod(real.c_str(), 0440);
        CHECK_THROWS_WITH(write_document(real, "x"), Contains("cannot write"));
        CHECK(read_file(real) == "new");
    }
    write_file(dir.path() / "file", "no folder");
    CHECK_THROWS_WITH(write_document(dir.path() / "file/a.fascicle", "x"), Contains("cannot"));
}
