// Real models and motions, against what OpenSim itself printed.

#include "fascicle/anatomy/line_measure.hpp"
#include "fascicle/io/mesh_file.hpp"
#include "fascicle/io/osim_file.hpp"
#include "fascicle/io/storage_file.hpp"
#include "support/data_dir.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace fascicle;

namespace {

constexpr double degree = std::numbers::pi / 180;

struct Hip {
    OsimModel file;
    StorageTable table;
    int flexion = -1;
};

Hip read_hip(const std::filesystem::path& data) {
    Hip hip{read_osim_file(data / "lhdl/LHDL_hip_r.osim"),
            read_storage_file(data / "lhdl/LHDL_hip_flexion_moment_arms.mot"), -1};
    hip.flexion = hip.file.model.skeleton.coordinate_index("hip_flexion_r");
    return hip;
}

/// OpenSim's figure at an angle, linear between its rows.
double printed(const StorageTable& table, int column, double degrees) {
    const auto angle = static_cast<std::size_t>(table.column_index("hip_flexion_r"));
    for (std::size_t r = 0; r + 1 < table.row_count(); ++r) {
        const double a = table.value(r, angle), b = table.value(r + 1, angle);
        if (degrees <= b) {
            const auto c = static_cast<std::size_t>(column);
            return table.value(r, c) + (degrees - a) / (b - a) * (table.value(r + 1, c) - table.value(r, c));
        }
    }
    return std::nan("");
}

} // namespace

TEST_CASE("hip model of this specimen: moment arms of all eight muscles are those of OpenSim",
          "[io][osim][data]") {
    FASCICLE_NEED_DATA(data);
    const Hip hip = read_hip(data);
    const LineModel& model = hip.file.model;
    REQUIRE(hip.file.version == 30000);
    REQUIRE(model.muscles.size() == 8);
    REQUIRE(hip.flexion >= 0);
    REQUIRE(hip.table.row_count() == 100);
    CHECK_FALSE(hip.table.in_degrees); // it says no, and its angles are degrees all the same
    LinePathSolver solver(model);
    Posture posture;
    std::vector<double> q = model.skeleton.default_values();
    double worst = 0, worst_difference = 0;
    int compared = 0;
    for (std::size_t row = 0; row < hip.table.row_count(); ++row) {
        q[static_cast<std::size_t>(hip.flexion)] = hip.table.value(row, 1) * degree;
        set_posture(model.skeleton, q, posture);
        for (std::size_t m = 0; m < model.muscles.size(); ++m) {
            const int column = hip.table.column_index(model.muscles[m].name);
            REQUIRE(column > 1);
            const double wanted_mm = 1000 * hip.table.value(row, static_cast<std::size_t>(column));
            const double by_difference =
                1000 * solver.moment_arm_by_difference(static_cast<int>(m), hip.flexion, posture);
            solver.solve(static_cast<int>(m), posture);
            const double arm_mm = 1000 * solver.moment_arm(hip.flexion, posture);
            worst = std::max(worst, std::abs(arm_mm - wanted_mm));
            worst_difference = std::max(worst_difference, std::abs(by_difference - arm_mm));
            ++compared;
        }
    }
    CHECK(compared == 800);
    INFO("worst " << worst << " mm");
    CHECK(worst < 0.01);
    CHECK(worst_difference < 0.001);
}

TEST_CASE("hip model of this specimen: moved by its motion, too", "[io][osim][data]") {
    FASCICLE_NEED_DATA(data);
    const Hip hip = read_hip(data);
    const LineModel& model = hip.file.model;
    const StorageTable motion = read_storage_file(data / "lhdl/LHDL_hip_flexion.mot");
    CHECK(motion.name == "hip_flexion");
    CHECK(motion.in_degrees);
    REQUIRE(motion.row_count() == 36);
    CHECK(motion.notes.size() == 1); // it says 51 rows
    const CoordinateColumns columns = match_coordinates(motion, model.skeleton);
    LinePathSolver solver(model);
    Posture posture;
    std::vector<double> q;
    double worst = 0;
    for (std::size_t row = 0; row < motion.row_count(); ++row) {
        coordinate_values(motion, columns, row, model.skeleton, q);
        CHECK(q[static_cast<std::size_t>(hip.flexion)] ==
              Approx((2.0 * static_cast<double>(row) - 10) * degree));
        set_posture(model.skeleton, q, posture);
        const double degrees = q[static_cast<std::size_t>(hip.flexion)] / degree;
        for (std::size_t m = 0; m < model.muscles.size(); ++m) {
            // Between two rows of the table the line is off by its curvature, and where a point comes or goes by the jump.
            const bool jumps = model.muscles[m].points.size() == 5 &&
                               (std::abs(degrees - 40) < 1.1 || std::abs(degrees - 54) < 1.1);
            if (jumps)
                continue;
            solver.solve(static_cast<int>(m), posture);
            const double wanted = printed(hip.table, hip.table.column_index(model.muscles[m].name), degrees);
            worst = std::max(worst, std::abs(solver.moment_arm(hip.flexion, posture) - wanted));
        }
    }
    CHECK(1000 * worst < 0.01);
}

TEST_CASE("hip model of this specimen: bodies, meshes, points", "[io][osim][data]") {
    FASCICLE_NEED_DATA(data);
    const Hip hip = read_hip(data);
    const LineModel& model = hip.file.model;
    const Skeleton& skeleton = model.skeleton;
    REQUIRE(skeleton.bodies.size() == 3);
    CHECK(skeleton.bodies[0].name == "ground");
    REQUIRE(skeleton.bodies[2].meshes.size() == 1);
    CHECK(skeleton.bodies[2].meshes[0].file == "./geometry/LHDL_femur_r.vtp");
    CHECK(skeleton.bodies[2].meshes[0].scale == Vec3(0.001, 0.001, 0.001));
    CHECK(skeleton.bodies[1].mass_kg == Approx(13.0926760095466));
    CHECK(skeleton.coordinates.size() == 9);
    CHECK(skeleton.coordinates[3].kind == CoordinateKind::translational);
    const LineMuscle& psoas = model.muscles[static_cast<std::size_t>(model.muscle_index("psoas_r"))];
    REQUIRE(psoas.points.size() == 5);
    CHECK(psoas.points[2].kind == PathPointKind::conditional);
    CHECK(psoas.points[2].range_max == Approx(40 * degree).epsilon(1e-5));
    CHECK(psoas.max_isometric_force_n == 1000);
    // At 0 the two bodies stand to each other as they were digitised, to a hundredth of a millimetre.
    Posture posture;
    set_posture(skeleton, skeleton.default_values(), posture);
    const Pose femur_in_pelvis = posture.poses[1].inverse().after(posture.poses[2]);
    CHECK((femur_in_pelvis.apply(Vec3(0.143478, 0.243439, -0.432669)) - Vec3(0.143478, 0.243439, -0.43267))
              .norm() < 1e-9);
}

TEST_CASE("gait2392: 92 muscles of plausible length, and arms that agree with differences",
          "[io][osim][data]") {
    FASCICLE_NEED_DATA(data);
    const OsimModel file = read_osim_file(data / "opensim/gait2392_thelen2003muscle.osim");
    const LineModel& model = file.model;
    const Skeleton& skeleton = model.skeleton;
    CHECK(file.version == 40000);
    CHECK(model.muscles.size() == 92);
    CHECK(skeleton.coordinates.size() == 23);
    CHECK(skeleton.bodies.size() == 13);
    CHECK(skeleton.joints.size() == 12);
    CHECK(file.notes.empty());
    int moving = 0, conditional = 0, meshes = 0;
    for (const Body& body : skeleton.bodies)
        meshes += static_cast<int>(body.meshes.size());
    CHECK(meshes == 20);
    LinePathSolver solver(model);
    Posture posture;
    std::vector<double> q = skeleton.default_values();
    set_posture(skeleton, q, posture);
    for (std::size_t m = 0; m < model.muscles.size(); ++m) {
        const LineMuscle& muscle = model.muscles[m];
        for (const PathPoint& point : muscle.points) {
            moving += point.kind == PathPointKind::moving ? 1 : 0;
            conditional += point.kind == PathPointKind::conditional ? 1 : 0;
        }
        // Muscle with tendon: tendons are slack below 1 and stretch by percents; fibres work between 0.4 and 1.6.
        const double length = solver.solve(static_cast<int>(m), posture).length;
        INFO(muscle.name << ' ' << length);
        CHECK(length > muscle.tendon_slack_length_m +
                           0.3 * muscle.optimal_fibre_length_m * std::cos(muscle.pennation_rad));
        CHECK(length < 1.1 * muscle.tendon_slack_length_m + 1.8 * muscle.optimal_fibre_length_m);
    }
    CHECK(moving == 8);
    CHECK(conditional == 26);

    // Mirror twins are of one length in a posture that is its own mirror image.
    for (const char* name : {"soleus", "rect_fem", "psoas", "glut_max1", "semimem"}) {
        const double right = solver.solve(model.muscle_index(std::string(name) + "_r"), posture).length;
        const double left = solver.solve(model.muscle_index(std::string(name) + "_l"), posture).length;
        CHECK(right == Approx(left).margin(1e-4));
    }

    const StorageTable motion = read_storage_file(data / "opensim/subject01_walk1_ik.mot");
    CHECK(motion.row_count() == 211);
    CHECK(motion.columns.size() == 165);
    CHECK(motion.in_degrees);
    CHECK(motion.notes.size() > 1); // inDegrees is not said; columns of forces have the same names twice
    const CoordinateColumns columns = match_coordinates(motion, skeleton);
    for (const int column : columns.column_of)
        CHECK(column >= 0);
    coordinate_values(motion, columns, 100, skeleton, q);
    set_posture(skeleton, q, posture);
    double worst = 0;
    for (std::size_t c = 0; c < skeleton.coordinates.size(); ++c)
        for (int m = 0; m < 92; ++m) {
            const double difference = solver.moment_arm_by_difference(m, static_cast<int>(c), posture);
            solver.solve(m, posture);
            worst = std::max(worst, std::abs(difference - solver.moment_arm(static_cast<int>(c), posture)));
        }
    INFO("worst " << 1000 * worst << " mm");
    CHECK(1000 * worst < 0.001);
    const auto arm_mm = [&](const char* muscle, const char* coordinate) {
        solver.solve(model.muscle_index(muscle), posture);
        return 1000 * solver.moment_arm(skeleton.coordinate_index(coordinate), posture);
    };
    CHECK(arm_mm("glut_max2_r", "hip_flexion_r") < -20); // extends the hip
    CHECK(arm_mm("psoas_r", "hip_flexion_r") > 20);
    CHECK(arm_mm("rect_fem_r", "knee_angle_r") > 20); // the knee's angle grows in extension
    CHECK(arm_mm("med_gas_r", "ankle_angle_r") < -30);
    CHECK(std::abs(arm_mm("soleus_r", "hip_flexion_r")) < 1e-9);
}

TEST_CASE("hip model of this specimen: muscles as strings over its bones stay out of them",
          "[io][osim][data][slow]") {
    FASCICLE_NEED_DATA(data);
    const Hip hip = read_hip(data);
    const LineModel& model = hip.file.model;
    std::vector<BodyObstacle> bones;
    for (const auto& [body, file] :
         {std::pair("pelvis", "lhdl/pelvis.obj"), std::pair("femur_r", "lhdl/femur.vtk")}) {
        TriMesh mesh = read_mesh_file(data / file).mesh;
        for (Vec3& x : mesh.positions)
            x /= 1000;
        bones.push_back({model.skeleton.body_index(body), std::make_shared<const BoneObstacle>(mesh)});
    }
    LinePathSolver solver(model);
    Posture posture;
    std::vector<double> q = model.skeleton.default_values();
    const auto measure = [&](const std::string& muscle, double degrees) {
        q[static_cast<std::size_t>(hip.flexion)] = degrees * degree;
        set_posture(model.skeleton, q, posture);
        const int m = model.muscle_index(muscle);
        return measure_string(model, m, hip.flexion, posture, measure_line(solver, m, hip.flexion, posture),
                              bones);
    };
    for (const char* muscle : {"glut_max2_r", "iliacus_r"}) {
        const double angle = 30, step = 2;
        const StringMeasure string = measure(muscle, angle);
        CHECK(string.path.clear);
        CHECK(string.path.length >= (string.path.points.back() - string.path.points.front()).norm());
        CHECK(std::count(string.path.touching.begin(), string.path.touching.end(), 0) > 0);
        const double difference =
            -(measure(muscle, angle + step).path.length - measure(muscle, angle - step).path.length) /
            (2 * step * degree);
        INFO(muscle << ": " << 1000 * string.moment_arm << " mm, by difference " << 1000 * difference);
        CHECK(std::abs(string.moment_arm - difference) < 1e-3);
        CHECK(std::abs(string.moment_arm) > 0.02);
        measure(muscle, angle); // back to its posture
        const std::size_t first = string.path.start_depth > 0 ? 1 : 0;
        const std::size_t last = string.path.points.size() - (string.path.end_depth > 0 ? 2 : 1);
        for (std::size_t i = first; i < last; ++i)
            for (const BodyObstacle& bone : bones)
                for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
                    const Vec3 x =
                        string.path.points[i] + share * (string.path.points[i + 1] - string.path.points[i]);
                    CHECK(bone.bone->distance(
                              posture.poses[static_cast<std::size_t>(bone.body)].apply_inverse(x)) > 0);
                }
    }
}
