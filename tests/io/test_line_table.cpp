#include "fascicle/base/error.hpp"
#include "fascicle/io/csv.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/line_table.hpp"
#include "fascicle/io/load_scene.hpp"
#include "fascicle/io/mesh_file.hpp"
#include "fascicle/io/project_file.hpp"
#include "support/line_model.hpp"
#include "support/temp_dir.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace fascicle;
using namespace fascicle::test;
using Catch::Matchers::Contains;

namespace {

/// The arm as files: two bones, a muscle, the model.
struct ArmFiles {
    TempDir dir;
    ArmFiles() {
        const Scene scene = arm_scene(0.5);
        write("base.obj", *scene.bones[0].mesh);
        write("arm.obj", *scene.bones[1].mesh);
        write("strap.obj", sphere(10, 2, Vec3(100, 25, 0)));
        write_file(path("arm.osim"), arm_osim(true));
    }
    std::filesystem::path path(const std::string& name) const { return dir.path() / name; }
    void write(const std::string& name, const TriMesh& mesh) const {
        MeshData data;
        data.mesh = mesh;
        write_mesh_file(path(name), data);
    }
    SceneRequest request() const {
        SceneRequest r;
        r.muscles = {path("strap.obj")};
        r.bones = {path("base.obj")};
        r.moving_bones = {path("arm.obj")};
        r.hinge = parse_hinge("0,0,0;0,0,1");
        r.angle_deg = 40;
        r.phases = Phases{4, 0, 0};
        r.lines = path("arm.osim");
        return r;
    }
};

} // namespace

TEST_CASE("line muscles: a model file into a scene, from meshes and from a project", "[io][lines]") {
    const ArmFiles files;
    const LoadedScene loaded = load_scene(files.request());
    REQUIRE(loaded.scene.line_muscles != nullptr);
    const LineMuscles& lines = *loaded.scene.line_muscles;
    CHECK(lines.source.path == files.path("arm.osim").string());
    CHECK_FALSE(lines.source.hash.empty());
    CHECK(lines.bone_of_body == std::vector<std::string>{"", "base", "arm"});
    std::string said;
    for (const std::string& note : loaded.notes)
        said += note + '\n';
    CHECK_THAT(said, Contains("line muscles: body arm_r goes with bone arm, by name"));

    write_project_file(files.path("arm.fascicle"), loaded.scene);
    SceneRequest again;
    again.project = files.path("arm.fascicle");
    const LoadedScene project = load_scene(again);
    REQUIRE(project.scene.line_muscles != nullptr);
    CHECK(project.scene.line_muscles->source.hash == lines.source.hash);
    const LineSeries a = line_series(loaded.scene), b = line_series(project.scene);
    CHECK(a.lengths_mm == b.lengths_mm);
    CHECK(a.moment_arms_mm == b.moment_arms_mm);

    Scene without = loaded.scene;
    without.line_muscles = nullptr;
    write_project_file(files.path("arm.fascicle"), without);
    CHECK(load_scene(again).scene.line_muscles == nullptr);
    again.lines = files.path("arm.osim"); // beside a project
    CHECK(load_scene(again).scene.line_muscles != nullptr);
}

TEST_CASE("line muscles: a file that is none, or of other bones, is one clear error", "[io][lines]") {
    const ArmFiles files;
    SceneRequest request = files.request();
    const auto fails = [&](const std::string& part) {
        CHECK_THROWS_WITH(load_scene(request), Contains("arm.osim") && Contains(part));
    };
    write_file(files.path("arm.osim"), "<OpenSimDocument");
    fails("");
    write_file(files.path("arm.osim"), arm_osim(false, "thorax", "ulna"));
    CHECK(load_scene(request).scene.line_muscles->bone_of_body[1] == "base"); // by nearness
    files.write("base.obj", sphere(5, 2, Vec3(200, 0, 30)));
    files.write("arm.obj", sphere(5, 2, Vec3(0, 50, 30)));
    fails("(thorax, ulna) belongs to a bone");
    files.write("arm.obj", sphere(5, 2, Vec3(0, 50, 300)));
    fails("from the bones in the mean");
    std::filesystem::remove(files.path("arm.osim"));
    fails("");
}

TEST_CASE("line table: a row per frame and muscle, and only its own kind is removed", "[io][lines]") {
    const ArmFiles files;
    const LineSeries series = line_series(load_scene(files.request()).scene);
    const std::filesystem::path path = files.path("lines.csv");
    write_line_table(path, series);
    const std::string bytes = read_file(path);
    CHECK(bytes.starts_with("frame,muscle,angle_deg,length_mm,moment_arm_mm\n0,flexor_r,0,"));
    CsvReader csv(bytes, path.string());
    std::size_t k = 0;
    for (; csv.next_row(); ++k) {
        CHECK(csv.number(0) == double(k));
        CHECK(csv.cell(1) == "flexor_r");
        CHECK(csv.number(2) == Approx(10.0 * double(k)).margin(1e-12));
        CHECK(csv.number(3) == series.length_mm(k, 0));
        CHECK(csv.number(4) == series.moment_arm_mm(k, 0));
    }
    CHECK(k == 5);
    remove_line_table(path);
    CHECK_FALSE(std::filesystem::exists(path));
    remove_line_table(path); // nothing there
    write_file(path, "frame,muscle,elbow_q_deg,length_mm,moment_arm_mm\n");
    remove_line_table(path);
    CHECK(std::filesystem::exists(path));
}
