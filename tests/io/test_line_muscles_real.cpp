// Line muscles of the hip model among the bones that it was made from, against what OpenSim printed.

#include "fascicle/io/load_scene.hpp"
#include "fascicle/io/mesh_file.hpp"
#include "fascicle/io/osim_file.hpp"
#include "fascicle/io/storage_file.hpp"
#include "fascicle/metrics/line_series.hpp"
#include "fascicle/scene/line_muscles.hpp"
#include "support/data_dir.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace fascicle;
using Catch::Matchers::Contains;

namespace {

constexpr double degree = std::numbers::pi / 180;
const Vec3 hip_centre(143.478, 243.439, -432.67); // mm, of the model

/// Iliac bone and femur as they were scanned; the femur flexes by 90 degrees, a frame a degree.
Scene hip_bones(const std::filesystem::path& data, const Vec3& axis, const Pose& femur = {}) {
    Scene scene;
    scene.bones.push_back({"right_iliac", nullptr, {}});
    scene.bones.push_back({"femur", nullptr, {}});
    for (Bone& bone : scene.bones) {
        TriMesh mesh = read_mesh_file(data / "lhdl" / (bone.name + ".vtk")).mesh;
        if (bone.name == "femur")
            for (Vec3& p : mesh.positions)
                p = femur.apply(p);
        bone.mesh = std::make_shared<const TriMesh>(std::move(mesh));
    }
    scene.timeline = make_hinge_timeline({hip_centre, axis}, -90 * degree, {90, 0, 0}, 2, {1});
    return scene;
}

struct Loaded {
    Scene scene;
    std::string notes;
    LineSeries series;
};

Loaded with_hip_lines(Scene scene, const std::filesystem::path& data) {
    Loaded loaded{std::move(scene), {}, {}};
    std::vector<std::string> notes;
    load_line_muscles(loaded.scene, data / "lhdl/LHDL_hip_r.osim", notes);
    for (const std::string& note : notes)
        loaded.notes += note + '\n';
    loaded.series = line_series(loaded.scene);
    return loaded;
}

/// Where the femur of the model stands in the pelvis when every coordinate is 0, scene units (mm).
Pose neutral_femur(const std::filesystem::path& data) {
    const LineModel model = read_osim_file(data / "lhdl/LHDL_hip_r.osim").model;
    Posture posture;
    set_posture(model.skeleton, model.skeleton.default_values(), posture);
    Pose femur = posture.poses[1].inverse().after(posture.poses[2]);
    femur.translation *= 1000;
    return femur;
}

/// The model's flexion axis in the frame of the meshes; flexion is positive about it.
Vec3 flexion_axis(const std::filesystem::path& data) {
    const LineModel model = read_osim_file(data / "lhdl/LHDL_hip_r.osim").model;
    return model.skeleton.joints[1].parent_frame.rotation.col(2);
}

/// Largest difference to OpenSim's table, mm, both at the same angle of flexion; linear between its rows.
double worst_difference(const LineSeries& series, const std::filesystem::path& data) {
    const StorageTable table = read_storage_file(data / "lhdl/LHDL_hip_flexion_moment_arms.mot");
    double worst = 0;
    int compared = 0;
    for (std::size_t k = 0; k < series.frames.size(); ++k) {
        const double flexion = -series.angles_rad[k] / degree;
        // Where a conditional point comes or goes between two rows the line between them means nothing.
        if (std::abs(flexion - 40) < 1.1 || std::abs(flexion - 54) < 1.1)
            continue;
        for (std::size_t r = 0; r + 1 < table.row_count(); ++r) {
            const double a = table.value(r, 1), b = table.value(r + 1, 1);
            if (flexion < a || flexion >= b)
                continue;
            for (std::size_t m = 0; m < series.muscles.size(); ++m) {
                const int column = table.column_index(series.muscles[m]);
                REQUIRE(column > 1);
                const auto c = static_cast<std::size_t>(column);
                const double printed =
                    table.value(r, c) + (flexion - a) / (b - a) * (table.value(r + 1, c) - table.value(r, c));
                worst = std::max(worst, std::abs(series.moment_arm_mm(k, m) - 1000 * printed));
                ++compared;
            }
        }
    }
    CHECK(compared > 8 * 80);
    return worst;
}

} // namespace

TEST_CASE("hip lines in a scene: with the femur as in the model's zero posture, arms are those of OpenSim",
          "[io][lines][data]") {
    FASCICLE_NEED_DATA(data);
    const Loaded hip = with_hip_lines(hip_bones(data, -flexion_axis(data), neutral_femur(data)), data);
    INFO(hip.notes);
    CHECK_THAT(hip.notes, Contains("the frame of body pelvis is the scene's"));
    CHECK_THAT(hip.notes, Contains("body pelvis goes with bone right_iliac, the nearest"));
    CHECK_THAT(hip.notes, Contains("body femur_r goes with bone femur, by name"));
    CHECK_THAT(hip.notes, Contains("hip_flexion_r turns with the joint, against its sense"));
    REQUIRE(hip.series.muscles.size() == 8);
    CHECK(hip.series.exact_arms);
    CHECK(worst_difference(hip.series, data) < 0.01);
    // About x, which is half a degree from the model's own axis.
    const Loaded about_x = with_hip_lines(hip_bones(data, Vec3::UnitX(), neutral_femur(data)), data);
    const double worst = worst_difference(about_x.series, data);
    INFO("about x: " << worst << " mm");
    CHECK(worst < 0.5);
}

TEST_CASE("hip lines in a scene: with the femur as scanned, arms are those of the model in that posture",
          "[io][lines][data]") {
    FASCICLE_NEED_DATA(data);
    const Loaded hip = with_hip_lines(hip_bones(data, -flexion_axis(data)), data);
    INFO(hip.notes);
    CHECK_THAT(hip.notes, Contains("the frame of every body is the scene's"));
    CHECK_THAT(hip.notes,
               Contains("posture hip_flexion_r 1.6, hip_adduction_r -4.7, hip_rotation_r -5.3 degrees"));
    const LineModel& model = *hip.scene.line_muscles->model;
    const int flexion = model.skeleton.coordinate_index("hip_flexion_r");
    LinePathSolver solver(model);
    Posture posture;
    double worst_arm = 0, worst_length = 0;
    for (std::size_t k = 0; k < hip.series.frames.size(); ++k) {
        std::vector<double> q = hip.scene.line_muscles->rest_values;
        q[static_cast<std::size_t>(flexion)] -= hip.series.angles_rad[k];
        set_posture(model.skeleton, q, posture);
        for (std::size_t m = 0; m < model.muscles.size(); ++m) {
            const double length = 1000 * solver.solve(static_cast<int>(m), posture).length;
            worst_length = std::max(worst_length, std::abs(length - hip.series.length_mm(k, m)));
            worst_arm = std::max(worst_arm, std::abs(1000 * solver.moment_arm(flexion, posture) -
                                                     hip.series.moment_arm_mm(k, m)));
        }
    }
    // The centres of the joint in the two bodies are 0.001 mm apart.
    CHECK(worst_length < 0.005);
    CHECK(worst_arm < 0.005);
    // The scan's posture is not OpenSim's: 5 degrees of adduction and rotation are millimetres of moment arm.
    const double worst = worst_difference(hip.series, data);
    INFO("as scanned, against OpenSim at zero adduction and rotation: " << worst << " mm");
    CHECK(worst > 1);
    CHECK(worst < 8);
}
