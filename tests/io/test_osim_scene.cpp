// Scenes from a small OpenSim model and a trial: bones, frames, meshes, projects, and what can be wrong.
#include "fascicle/base/error.hpp"
#include "fascicle/base/state_hash.hpp"
#include "fascicle/geometry/solid_query.hpp"
#include "fascicle/geometry/volume.hpp"
#include "fascicle/io/project_file.hpp"
#include "fascicle/metrics/line_series.hpp"
#include "fascicle/scene/model_motion.hpp"
#include "fascicle/simulation/simulation.hpp"
#include "io/osim_scene/osim_bones.hpp"
#include "support/json_schema.hpp"
#include "support/osim_scene.hpp"

#include <catch2/catch.hpp>
#include <numbers>

using namespace fascicle;
using namespace fascicle::test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

bool says(const LoadedScene& loaded, const std::string& part) {
    return std::any_of(loaded.notes.begin(), loaded.notes.end(),
                       [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

std::string error_of(const SceneRequest& request) {
    try {
        load_scene(request);
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

std::string state_of(const Scene& scene) {
    Recording recording(std::make_shared<const Scene>(scene));
    run_simulation(recording, {1, nullptr}, {});
    REQUIRE(recording.state() == RunState::finished);
    StateHash hash;
    for (const PointsPtr& points : recording.last_frame()->muscle_positions)
        hash.add_points(*points);
    return hash.hex();
}

} // namespace

TEST_CASE("A model and a trial make bones that turn as the joint says", "[io][osim_scene]") {
    const OsimFiles files;
    const LoadedScene loaded = load_scene(files.request());
    const Scene& scene = loaded.scene;
    REQUIRE(scene.bones.size() == 2);
    CHECK(scene.bones[0].name == "base");
    CHECK(scene.bones[1].name == "arm_r");
    CHECK(scene.unit == LengthUnit::metre);
    const ModelMotion* motion = model_motion_in_force(scene);
    REQUIRE(motion != nullptr);
    // 0.06 rad at most 1.5 degrees a frame, the slope of the way there being at most 1.5: 3.4 frames.
    CHECK(motion->lead_in == 4);
    CHECK(scene.timeline.last_frame == 6);
    CHECK(motion->frame_s == Approx(0.02));
    CHECK(scene.parameters.get("solver.frame_time") == Approx(0.02));
    for (int k = 0; k <= 6; ++k) {
        const double u = std::min(1.0, k / 4.0);
        const double angle = k <= 4 ? 0.06 * u * u * (3 - 2 * u) : 0.06 * (k - 3);
        CHECK(scene.timeline.angle_rad(k) == Approx(angle).margin(1e-14));
        const Pose wanted = rotation_about(Vec3::Zero(), Vec3::UnitZ(), angle);
        const Pose arm = scene.timeline.bone_pose(1, k);
        CHECK((arm.rotation - wanted.rotation).norm() < 1e-13);
        CHECK(arm.translation.norm() < 1e-13);
        CHECK(scene.timeline.bone_pose(0, k).is_identity());
    }
    CHECK_FALSE(scene.timeline.moves(0));
    CHECK(says(loaded, "angle_deg is elbow_q"));
}

TEST_CASE("A muscle without a mesh is a spindle of the volume that the model implies", "[io][osim_scene]") {
    const OsimFiles files;
    const LoadedScene loaded = load_scene(files.request());
    const Muscle& muscle = loaded.scene.muscles.at(0);
    // 60 N / 60 N/cm2 = 1 cm2, times 5 cm.
    CHECK(signed_volume(muscle.mesh->positions, muscle.mesh->triangles) == Approx(5e-6).epsilon(0.02));
    CHECK(says(loaded, "flexor_r: no mesh, a spindle stands in for it: 5.0 cm3"));
    REQUIRE(muscle.attachments.size() == 2);
    CHECK(muscle.attachments[0].kind == AttachmentKind::origin);
    CHECK(muscle.attachments[0].bone == 0);
    CHECK(muscle.attachments[1].bone == 1);
    for (const Bone& bone : loaded.scene.bones) {
        const SolidQuery solid(*bone.mesh);
        int inside = 0;
        for (const Vec3& p : muscle.mesh->positions)
            inside += solid.signed_distance(p) < 0 ? 1 : 0;
        CHECK(inside == 0);
    }
}

TEST_CASE("Lines of the model have exact moment arms about the coordinate", "[io][osim_scene]") {
    const OsimFiles files;
    const Scene scene = load_scene(files.request()).scene;
    const LineSeries series = line_series(scene);
    CHECK(series.exact_arms);
    REQUIRE(series.coordinates == std::vector<std::string>{"elbow_q"});
    for (std::size_t k = 0; k < series.frames.size(); ++k) {
        const double q = series.angles_rad[k];
        const Vec3 end = rotation_about(Vec3::Zero(), Vec3::UnitZ(), q).apply(Vec3(0, 0.05, 0));
        const Vec3 line = Vec3(0.2, 0, 0) - end;
        CHECK(series.length_mm(k, 0) == Approx(1000 * line.norm()).epsilon(1e-12));
        const double arm = end.cross(line.normalized()).z(); // of the pull, about z
        CHECK(series.moment_arm_mm(k, 0) == Approx(1000 * arm).epsilon(1e-9));
        CHECK(series.coordinate_arms_mm[k] == series.moment_arm_mm(k, 0));
    }
}

TEST_CASE("The part and the frames of a trial are the user's to choose", "[io][osim_scene]") {
    const OsimFiles files;
    SceneRequest r = files.request();
    r.osim.reading.from_s = 0.52;
    Scene scene = load_scene(r).scene;
    CHECK(scene.model_motion->lead_in == 7); // 0.12 rad
    CHECK(scene.timeline.last_frame == 8);
    CHECK(scene.timeline.angle_rad(8) == Approx(0.18));
    r.osim.reading = {0.5, 0.54, 8};
    scene = load_scene(r).scene;
    CHECK(scene.timeline.last_frame == 4 + 8);
    for (int k = 0; k <= 8; ++k)
        CHECK(scene.timeline.angle_rad(4 + k) == Approx(0.06 + 0.12 * k / 8));
    r.osim.reading = {0.6, {}, 0};
    CHECK_THAT(error_of(r), Contains("does not reach from 0.6") && Contains("0.5 to 0.54 s"));
    r.osim.reading = {0.53, 0.54, 0};
    CHECK_THAT(error_of(r), Contains("fewer than two rows"));
}

TEST_CASE("Uneven steps, gaps, jumps and doubtful units of a trial are told", "[io][osim_scene]") {
    const OsimFiles files;
    files.trial("time\telbow_q\tknee\n0\t0\t1\n0.02\t0.1\t1\n0.04\t0.2\t1\n0.06\t0.2\t1\n0.26\t0.3\t1\n0."
                "28\t0.8\t1\n");
    const LoadedScene loaded = load_scene(files.request());
    CHECK(says(loaded, "time steps are uneven (0.02 to 0.2 s)"));
    CHECK(says(loaded, "1 gap, the widest of 0.2 s before line 9"));
    CHECK(says(loaded, "jumps between frames: elbow_q by 28.6"));
    CHECK(says(loaded, "no coordinates: knee"));
    CHECK(loaded.scene.timeline.last_frame == 14); // first row is rest
    CHECK(loaded.scene.model_motion->lead_in == 0);
    CHECK(loaded.scene.timeline.angle_rad(8) == Approx(0.25)); // the middle of the gap
    files.trial("time\telbow_q\n0\t0\n1\t1\n2\t1.5\n", "inDegrees=yes\n");
    CHECK(says(load_scene(files.request()), "stay within 1.5 degrees: are they radians?"));
}

TEST_CASE("Trials that cannot be followed are refused with their line", "[io][osim_scene]") {
    const OsimFiles files;
    const auto fails = [&](const std::string& rows, const std::string& what) {
        files.trial(rows);
        CHECK_THAT(error_of(files.request()), Contains("trial.mot") && Contains(what));
    };
    fails("time\telbow_q\n0\t0\n0.1\tnan\n", "line 6");
    fails("time\telbow_q\n0\t0\n0.1\t0.1\n0.1\t0.2\n", "line 7: the time does not ascend");
    fails("elbow_q\n0\n0.1\n", "no column 'time'");
    fails("time\telbow_q\n0\t0\n", "fewer than two rows");
    fails("time\tknee\n0\t0\n1\t1\n", "no column is a coordinate of the model");
    fails("time\telbow_q\n0\t0\n1\t3.14159265\n", "half a turn or more before frame 1");
    fails("time\telbow_q\n0\t0\n1\t0\n", "no bone moves");
}

TEST_CASE("Meshes are found as OpenSim finds them, and missing ones are named", "[io][osim_scene]") {
    const OsimFiles files;
    fs::remove(files.path("Geometry/ARM.obj"));
    SceneRequest r = files.request();
    CHECK_THAT(error_of(r), Contains("muscle 'flexor_r' attaches to body 'arm_r', which has no bone"));
    r.muscles.clear();
    const LoadedScene loaded = load_scene([&] {
        SceneRequest moving = r;
        files.ball("arm.obj", Vec3(0, 0.032, 0)); // beside the model
        return moving;
    }());
    CHECK(loaded.scene.bones.size() == 2);
    fs::remove(files.path("arm.obj"));
    fs::remove(files.path("Geometry/base.obj"));
    CHECK_THAT(error_of(r), Contains("no mesh of a body was found: base (base.obj); arm_r (arm.obj)"));
    files.model("base.obj", "../../etc/passwd");
    files.ball("Geometry/base.obj", Vec3(0.2, -0.018, 0));
    CHECK_THAT(error_of(r), Contains("no bone moves")); // that file was not even looked at
}

TEST_CASE("A model that names one large mesh again and again is refused, and a file is read once",
          "[io][osim_scene]") {
    const OsimFiles files;
    std::string points;
    for (int i = 0; i < 13000; ++i)
        points += "v 0 0 0\n";
    points += "v 0 0 1\nv 0 1 0\nf 1 13001 13002\n";
    write_file(files.path("Geometry/many.obj"), points);
    std::string names = "many.obj";
    for (int i = 0; i < 400; ++i)
        names += "</mesh_file></Mesh><Mesh name=\"m\"><mesh_file>many.obj";
    files.model("base.obj", names);
    SceneRequest r = files.request();
    CHECK_THAT(
        error_of(r),
        Contains("arm.osim") &&
            Contains(
                "the meshes of body 'arm_r' have more than 5 million points or triangles with many.obj"));

    // What its reader says is said once.
    MeshData data;
    data.mesh = sphere(0.015, 2, Vec3(0, 0.032, 0));
    write_mesh_file(files.path("Geometry/ball.stl"), data);
    files.model("base.obj", "ball.stl</mesh_file></Mesh><Mesh name=\"m\"><mesh_file>ball.stl");
    const LoadedScene loaded = load_scene(r);
    CHECK(std::count_if(loaded.notes.begin(), loaded.notes.end(), [](const std::string& note) {
              return note.find("ball.stl: ") != std::string::npos &&
                     note.find("corners of triangles") != std::string::npos;
          }) == 1);

    // Bodies together.
    io::ModelMeshes meshes(files.path("arm.osim"));
    io::ModelMeshes::Part part{"part.obj", {}};
    part.mesh.positions.assign(io::ModelMeshes::most_in_body, Vec3::Zero());
    Body body;
    body.name = "b";
    for (std::size_t i = 0; i < io::ModelMeshes::most_in_all / io::ModelMeshes::most_in_body; ++i)
        CHECK_NOTHROW(meshes.use(part, body, {}));
    CHECK_THROWS_WITH(meshes.use(part, body, {}),
                      Contains("its bodies have more than 20 million points or triangles with part.obj"));
}

TEST_CASE("Own meshes in millimetres go with a model in metres", "[io][osim_scene]") {
    const OsimFiles files;
    files.ball("base_mm.obj", Vec3(0.2, -0.018, 0), 1000);
    files.ball("arm_mm.obj", Vec3(0, 0.032, 0), 1000);
    SceneRequest r = files.request();
    r.bones = {files.path("base_mm.obj").string() + "=base", files.path("arm_mm.obj").string() + "=arm_r"};
    const LoadedScene loaded = load_scene(r);
    CHECK(says(loaded, "unit guessed: millimetres (diagonal 2"));
    CHECK(loaded.scene.unit == LengthUnit::millimetre);
    CHECK(loaded.scene.bones[1].name == "arm_mm");
    CHECK_FALSE(loaded.scene.bones[1].source.hash.empty()); // its numbers are the file's
    const Muscle& muscle = loaded.scene.muscles[0];
    CHECK(signed_volume(muscle.mesh->positions, muscle.mesh->triangles) == Approx(5000).epsilon(0.02));
    SceneRequest metres = r;
    metres.unit = LengthUnit::metre;
    metres.muscles.clear();
    CHECK(load_scene(metres).scene.unit == LengthUnit::metre);
}

TEST_CASE("A muscle's own mesh tells which frame the meshes are in", "[io][osim_scene]") {
    const OsimFiles files;
    // At the model's default posture: an ellipsoid that just reaches from ball to ball.
    MeshData data;
    data.mesh = sphere(1, 3);
    const Vec3 a(0.2, -0.018, 0), b(0, 0.032, 0);
    const Mat3 turn = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitX(), b - a).toRotationMatrix();
    const Vec3 half(0.5 * (b - a).norm() - 0.015, 0.006, 0.006);
    for (Vec3& p : data.mesh.positions)
        p = turn * half.cwiseProduct(p) + 0.5 * (a + b);
    write_mesh_file(files.path("strip.obj"), data);
    SceneRequest r = files.request();
    r.muscles = {files.path("strip.obj").string() + "=base,arm_r"};
    const LoadedScene loaded = load_scene(r);
    CHECK(says(loaded, "meshes are guessed to be in the frame of their (first) body"));
    CHECK(loaded.scene.muscles[0].attach_to == std::vector<std::string>{"base", "arm_r"});
    r.osim.mesh_frame = MeshFrame::ground;
    CHECK(says(load_scene(r), "taken to be in the model's ground"));
    for (Vec3& p : data.mesh.positions)
        p += Vec3(0, 0, 3);
    write_mesh_file(files.path("strip.obj"), data);
    CHECK_THAT(error_of(r), Contains("away from or inside of their bones"));
}

TEST_CASE("Axes turn only when they are asked to, and never mirror", "[io][osim_scene]") {
    const OsimFiles files;
    SceneRequest r = files.request();
    const Scene plain = load_scene(r).scene;
    r.osim.axes = AxisMapping::opensim_to_lps;
    const Scene turned = load_scene(r).scene;
    const Mat3 m = axis_matrix(r.osim.axes);
    for (std::size_t b = 0; b < 2; ++b) {
        const Points &p = plain.bones[b].mesh->positions, &q = turned.bones[b].mesh->positions;
        for (std::size_t i = 0; i < p.size(); ++i)
            CHECK((m * p[i] - q[i]).norm() < 1e-12);
        CHECK(signed_volume(q, turned.bones[b].mesh->triangles) > 0);
        for (int k = 0; k <= turned.timeline.last_frame; ++k)
            CHECK((m * plain.timeline.bone_pose(static_cast<int>(b), k).apply(p[3]) -
                   turned.timeline.bone_pose(static_cast<int>(b), k).apply(q[3]))
                      .norm() < 1e-12);
    }
    const LineSeries a = line_series(plain), c = line_series(turned);
    for (std::size_t k = 0; k < a.frames.size(); ++k) {
        CHECK(a.length_mm(k, 0) == Approx(c.length_mm(k, 0)).epsilon(1e-12));
        CHECK(a.moment_arm_mm(k, 0) == Approx(c.moment_arm_mm(k, 0)).epsilon(1e-9));
    }
}

TEST_CASE("A project of a model gives the same run, and a missing model is named", "[io][osim_scene]") {
    const OsimFiles files;
    SceneRequest r = files.request();
    r.osim.axes = AxisMapping::opensim_to_lps;
    r.osim.reading.to_s = 0.53;
    const Scene scene = load_scene(r).scene;
    write_project_file(files.path("p.fascicle"), scene);
    static const nlohmann::json schema =
        nlohmann::json::parse(read_file(fs::path(FASCICLE_SOURCE_DIR) / "resources/project.schema.json"));
    CHECK(schema_fault(nlohmann::json::parse(read_file(files.path("p.fascicle"))), schema, schema).empty());
    const Project project = read_project_file(files.path("p.fascicle"));
    CHECK(project.notes.empty());
    REQUIRE(model_motion_in_force(project.scene) != nullptr);
    CHECK(project.scene.model_motion->values == scene.model_motion->values);
    CHECK(project.scene.model_motion->reading == scene.model_motion->reading);
    REQUIRE(project.scene.line_muscles != nullptr);
    CHECK(line_series(project.scene).lengths_mm == line_series(scene).lengths_mm);
    CHECK(state_of(project.scene) == state_of(scene));
    write_project_file(files.path("again.fascicle"), project.scene, project.text);
    CHECK(read_file(files.path("again.fascicle")) == read_file(files.path("p.fascicle")));

    fs::rename(files.path("arm.osim"), files.path("elsewhere.osim"));
    CHECK_THROWS_WITH(read_project_file(files.path("p.fascicle")), Contains("arm.osim"));
    const std::vector<MissingFile> missing = missing_project_files(files.path("p.fascicle"));
    REQUIRE(missing.size() == 1);
    CHECK(missing[0].what == "OpenSim model");
    const Project found =
        read_project_file(files.path("p.fascicle"), 1, {}, {{missing[0].path, files.path("elsewhere.osim")}});
    CHECK(model_motion_in_force(found.scene) != nullptr);
    // Another trial under the name: the timeline of the project stays, without the model's numbers.
    fs::rename(files.path("elsewhere.osim"), files.path("arm.osim"));
    files.trial("time\telbow_q\n0\t0.3\n1\t0.2\n");
    const Project changed = read_project_file(files.path("p.fascicle"));
    CHECK(changed.notes.size() == 1);
    CHECK(model_motion_in_force(changed.scene) == nullptr);
    CHECK(changed.scene.timeline.angle_rad(5) == scene.timeline.angle_rad(5));
    files.trial("time\telbow_q\n0.5\t0.06\n0.52\t0.13\n0.54\t0.18\n");
    const Project edited = read_project_file(files.path("p.fascicle"));
    CHECK(edited.notes.size() == 1);
    CHECK(edited.scene.model_motion != nullptr);
    CHECK(model_motion_in_force(edited.scene) == nullptr);
}

TEST_CASE("Options about a model are refused where they mean nothing", "[io][osim_scene]") {
    const OsimFiles files;
    const auto usage = [](const SceneRequest& request, const std::string& words) {
        try {
            load_scene(request);
            FAIL("no error");
        } catch (const Error& error) {
            CHECK(error.kind() == ErrorKind::usage);
            CHECK_THAT(error.what(), Contains(words));
        }
    };
    SceneRequest r = files.request();
    r.motion.clear();
    usage(r, "--motion TRIAL.mot");
    r = files.request();
    r.hinge = HingeRequest{};
    usage(r, "cannot go with --osim");
    r = files.request();
    r.muscles = {"flexor_r=arm_r,base"};
    usage(r, "goes from base to arm_r");
    r.muscles = {"flexor_r=base,leg"};
    usage(r, "no body 'leg'");
    r.muscles = {files.path("Geometry/base.obj").string()};
    usage(r, "MESH=BODY,BODY");
    r = files.request();
    r.osim.coordinate = "elbow";
    usage(r, "did you mean 'elbow_q'?");
    r = files.request();
    r.osim.model.clear();
    r.embedded = "squish-box";
    r.muscles.clear();
    r.osim.coordinate = "elbow_q";
    usage(r, "is about a model");
    r = files.request();
    r.muscles = {"flexor=base,arm_r"};
    CHECK_THAT(error_of(r), Contains("no such file, and no muscle of the model; did you mean 'flexor_r'?"));
}
