// Real models and trials as scenes, against joints written out by hand.
#include "fascicle/io/load_scene.hpp"
#include "fascicle/io/storage_file.hpp"
#include "fascicle/scene/model_motion.hpp"
#include "fascicle/simulation/simulation.hpp"
#include "support/data_dir.hpp"

#include <catch2/catch.hpp>
#include <numbers>

using namespace fascicle;
namespace fs = std::filesystem;

namespace {

constexpr double degree = std::numbers::pi / 180;

Eigen::Affine3d turn(const Vec3& axis, double degrees) {
    return Eigen::Affine3d(Eigen::AngleAxisd(degrees * degree, axis));
}

/// A frame in a body: body-fixed turns about x, y, z in radians.
Eigen::Affine3d frame(const Vec3& at, const Vec3& xyz) {
    return Eigen::Translation3d(at) * Eigen::AngleAxisd(xyz.x(), Vec3::UnitX()) *
           Eigen::AngleAxisd(xyz.y(), Vec3::UnitY()) * Eigen::AngleAxisd(xyz.z(), Vec3::UnitZ());
}

double cell(const StorageTable& table, std::size_t row, const std::string& column) {
    return table.value(row, static_cast<std::size_t>(table.column_index(column)));
}

SceneRequest hip_request(const fs::path& data) {
    SceneRequest r;
    r.osim.model = data / "lhdl/LHDL_hip_r.osim";
    r.motion = data / "lhdl/LHDL_hip_flexion.mot";
    r.bones = {(data / "lhdl/femur.vtk").string() + "=femur_r",
               (data / "lhdl/pelvis.obj").string() + "=pelvis"};
    return r;
}

SceneRequest gait_request(const fs::path& data) {
    SceneRequest r;
    r.osim.model = data / "opensim/gait2392_thelen2003muscle.osim";
    r.motion = data / "opensim/subject01_walk1_ik.mot";
    return r;
}

bool says(const LoadedScene& loaded, const std::string& part) {
    return std::any_of(loaded.notes.begin(), loaded.notes.end(),
                       [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

} // namespace

TEST_CASE("hip model and its trial: meshes in millimetres follow the model's joint to 1e-9",
          "[io][osim_scene][data][slow]") {
    FASCICLE_NEED_DATA(data);
    SceneRequest r = hip_request(data);
    r.osim.mesh_frame = MeshFrame::scan;
    const LoadedScene loaded = load_scene(r);
    const Scene& scene = loaded.scene;
    CHECK(scene.unit == LengthUnit::millimetre);
    CHECK(says(loaded, "unit guessed: millimetres"));
    CHECK(says(loaded, "hip_flexion_r_deg 1.6, hip_adduction_r_deg -4.7, hip_rotation_r_deg -5.3"));
    CHECK_FALSE(scene.bones[0].source.hash.empty()); // as in its file
    const ModelMotion* motion = model_motion_in_force(scene);
    REQUIRE(motion != nullptr);
    const StorageTable table = read_storage_file(r.motion);
    REQUIRE(scene.timeline.last_frame - motion->lead_in == static_cast<int>(table.row_count()) - 1);
    const Eigen::Affine3d parent = frame({143.478, 243.439, -432.67}, {-2.77372, -1.56193, 1.80849}),
                          child = frame({143.478, 243.439, -432.669}, {-0.806673, -1.45075, -2.47682});
    double worst = 0;
    for (std::size_t row = 0; row < table.row_count(); ++row) {
        const double flexion = cell(table, row, "hip_flexion_r");
        const int k = motion->lead_in + static_cast<int>(row);
        CHECK(scene.timeline.angle_rad(k) == Approx(flexion * degree).margin(1e-12));
        const Eigen::Affine3d wanted = parent * turn(Vec3::UnitZ(), flexion) * child.inverse();
        const Pose pose = scene.timeline.bone_pose(0, k);
        for (const Vec3& p : {Vec3(143, 243, -432), Vec3(100, 280, -850)})
            worst = std::max(worst, (pose.apply(p) - wanted * p).norm());
        CHECK(scene.timeline.bone_pose(1, k).is_identity()); // snapped: what is left is rounding
    }
    CHECK(worst < 1e-9);
}

TEST_CASE("hip model: the frame of its meshes is found from muscles and bones",
          "[io][osim_scene][data][slow]") {
    FASCICLE_NEED_DATA(data);
    SceneRequest r = hip_request(data);
    r.muscles = {(data / "lhdl/gluteus_maximus.vtk").string() + "=pelvis,femur_r",
                 (data / "lhdl/iliacus.vtk").string() + "=pelvis,femur_r"};
    const LoadedScene loaded = load_scene(r);
    CHECK(says(loaded, "guessed to be in one frame that is that of every body, as scanned"));
    CHECK(loaded.scene.model_motion->mesh_frame == MeshFrame::scan);
    CHECK(loaded.scene.muscles[1].attach_to == std::vector<std::string>{"pelvis", "femur"});
    CHECK_FALSE(loaded.scene.muscles[1].source.hash.empty());
}

TEST_CASE("gait model and a walking trial: pelvis and femur follow joints written out by hand",
          "[io][osim_scene][data][slow]") {
    FASCICLE_NEED_DATA(data);
    const LoadedScene loaded = load_scene(gait_request(data));
    const Scene& scene = loaded.scene;
    REQUIRE(scene.bones.size() == 2);
    CHECK(scene.bones[0].name == "pelvis");
    CHECK(scene.bones[1].name == "femur_r");
    CHECK(says(loaded, "tibia_r (tibia_r.vtp, fibula.vtp)"));
    const ModelMotion* motion = model_motion_in_force(scene);
    REQUIRE(motion != nullptr);
    const StorageTable table = read_storage_file(gait_request(data).motion);
    REQUIRE(scene.timeline.last_frame - motion->lead_in == 210);
    double worst = 0;
    for (std::size_t row = 0; row < table.row_count(); row += 7) {
        const auto value = [&](const char* name) { return cell(table, row, name); };
        const Vec3 at(value("pelvis_tx"), value("pelvis_ty"), value("pelvis_tz"));
        const Eigen::Affine3d pelvis = Eigen::Translation3d(at) * turn(Vec3::UnitZ(), value("pelvis_tilt")) *
                                       turn(Vec3::UnitX(), value("pelvis_list")) *
                                       turn(Vec3::UnitY(), value("pelvis_rotation"));
        const Eigen::Affine3d femur = pelvis * Eigen::Translation3d(-0.0707, -0.0661, 0.0835) *
                                      turn(Vec3::UnitZ(), value("hip_flexion_r")) *
                                      turn(Vec3::UnitX(), value("hip_adduction_r")) *
                                      turn(Vec3::UnitY(), value("hip_rotation_r"));
        const int k = motion->lead_in + static_cast<int>(row);
        const Pose moved[2] = {scene.timeline.bone_pose(0, k), scene.timeline.bone_pose(1, k)};
        const Eigen::Affine3d wanted[2] = {pelvis, femur};
        const std::size_t body[2] = {1, 2};
        for (int b = 0; b < 2; ++b) {
            const Pose rest = motion->rest[body[b]];
            for (const Vec3& p : {Vec3(0, 0, 0), Vec3(0.1, -0.4, 0.2)})
                worst = std::max(worst, (moved[b].apply(rest.apply(p)) - wanted[b] * p).norm());
        }
    }
    CHECK(worst < 1e-9);
    // A bounded way from rest: no coordinate of the lead-in turns by more than 1.5 degrees a frame or shifts by more than 20 mm.
    for (int k = 1; k <= motion->lead_in; ++k)
        for (std::size_t c = 0; c < motion->coordinate_count(); ++c) {
            const bool turns = motion->model->skeleton.coordinates[c].kind == CoordinateKind::rotational;
            CHECK(std::abs(motion->at(k)[c] - motion->at(k - 1)[c]) <= (turns ? 1.5 * degree : 0.02) + 1e-9);
        }
}

TEST_CASE("gait model: a muscle that stands in for its line goes through a gait cycle",
          "[io][osim_scene][data][slow]") {
    FASCICLE_NEED_DATA(data);
    SceneRequest r = gait_request(data);
    r.muscles = {"glut_max2_r"};
    r.osim.reading = {0.5, 1.7, 14};
    LoadedScene loaded = load_scene(r);
    loaded.scene.parameters.set("solver.iterations", 4);
    Recording recording(std::make_shared<const Scene>(loaded.scene));
    run_simulation(recording, {1, nullptr}, {});
    REQUIRE(recording.state() == RunState::finished);
    CHECK(recording.last_frame()->index == loaded.scene.model_motion->lead_in + 14);
    CHECK(recording.last_frame()->report.non_finite == 0);
}
