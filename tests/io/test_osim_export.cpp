// Runs by formula, written as OpenSim models and read back.

#include "fascicle/anatomy/line_measure.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/geometry/volume.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/mesh_file.hpp"
#include "fascicle/io/osim_export.hpp"
#include "fascicle/io/osim_file.hpp"
#include "fascicle/io/storage_file.hpp"
#include "support/rope_run.hpp"
#include "support/temp_dir.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <set>

using namespace fascicle;
using fascicle::test::RopeMuscle;
using fascicle::test::TempDir;
using fascicle::test::WrappedRope;

namespace {

RecordingPtr wrapped_run(const Phases& phases = {40, 0, 0}, double angle = 0.8) {
    const WrappedRope rope;
    const Timeline timeline = make_hinge_timeline(test::x_hinge(), angle, phases, 2, {1});
    return test::rope_run({"base", "block"}, timeline,
                          {{"strap", rope.levels(), [=](int r, int level, int k) {
                                return rope.place(r, level, timeline.angle_rad(k));
                            }}});
}

/// Scene (mm, LPS) to model (m, Y up).
Vec3 in_model(const Vec3& p) {
    return Vec3(-p.y(), p.z(), -p.x()) / 1000;
}

struct Measured {
    double length_mm = 0, arm_mm = 0, opensim_arm_mm = 0;
};

/// Of a model read back, at a value of all of its coordinates. OpenSim's arm: from the lengths of the segments between different bodies alone,
/// by a central difference.
Measured measured(const LineModel& model, int muscle, double q) {
    LinePathSolver solver(model);
    const auto at = [&](double value) {
        Posture posture;
        set_posture(model.skeleton, std::vector<double>(model.skeleton.coordinates.size(), value), posture);
        return posture;
    };
    const LineMeasure line = measure_line(solver, muscle, 0, at(q));
    const auto crossing = [&](double value) {
        const LineMeasure there = measure_line(solver, muscle, -1, at(value));
        const std::vector<PathPoint>& points = model.muscles[static_cast<std::size_t>(muscle)].points;
        double sum = 0;
        for (std::size_t i = 0; i + 1 < points.size(); ++i)
            if (points[i].body != points[i + 1].body)
                sum += (there.polyline[i + 1] - there.polyline[i]).norm();
        return sum;
    };
    const double h = 1e-5;
    return {1000 * line.length, 1000 * line.moment_arm,
            -1000 * (crossing(q + h) - crossing(q - h)) / (2 * h)};
}

} // namespace

TEST_CASE("A rope round a cylinder keeps its length and moment arm as an OpenSim muscle",
          "[io][osim_export]") {
    const TempDir folder;
    const RecordingPtr run = wrapped_run();
    OsimExportOptions options;
    options.tolerance_mm = 0.05;
    const OsimExportReport report = export_osim(folder.path() / "ropes.osim", *run, options);
    CHECK(report.model == folder.path() / "ropes.osim");
    CHECK(report.coordinate == "block_angle");
    const OsimModel back = read_osim_file(report.model);
    CHECK(back.version == 40000);
    CHECK(back.notes.empty());
    const Coordinate& q = back.model.skeleton.coordinates.at(0);
    CHECK(q.name == "block_angle");
    CHECK(q.kind == CoordinateKind::rotational);
    CHECK(q.range_min == 0);
    CHECK(q.range_max == 0.8);
    CHECK(q.clamped);
    CHECK_FALSE(q.locked);
    REQUIRE(back.model.muscles.size() == 4);
    const WrappedRope rope;
    for (int f = 0; f < 4; ++f) {
        CHECK(back.model.muscles[static_cast<std::size_t>(f)].name == "strap_f0" + std::to_string(f + 1));
        const double r = WrappedRope::radius(f);
        for (int i = 0; i <= 50; ++i) {
            const double angle = 0.8 * i / 50;
            const Measured m = measured(back.model, f, angle);
            INFO("rope " << f << " angle " << angle);
            CHECK(m.length_mm == Approx(rope.length(f, angle)).margin(0.05));
            CHECK(m.length_mm == Approx(140 + r * (std::numbers::pi / 2 + angle)).margin(0.15));
            CHECK(m.arm_mm == Approx(-r).margin(0.2));
            CHECK(m.opensim_arm_mm == Approx(m.arm_mm).margin(1e-4));
        }
    }
    CHECK(report.bone_mm < 1e-6);
    CHECK(report.largest(&OsimFibreReport::length_mm) < 0.05);
    CHECK(report.largest(&OsimFibreReport::moment_arm_mm) < 0.05);
    CHECK(report.largest(&OsimFibreReport::exact_moment_arm_mm) < 0.05);
    CHECK(report.largest(&OsimFibreReport::opensim_moment_arm_mm) < 0.05);
    CHECK(report.largest(&OsimFibreReport::point_mm) < 0.05);
    // Less is asked for: fewer knots.
    options.tolerance_mm = 1;
    const OsimExportReport coarse = export_osim(folder.path() / "ropes.osim", *run, options);
    CHECK(coarse.fibres[0].knots < report.fibres[0].knots);
    CHECK(coarse.largest(&OsimFibreReport::length_mm) < 1);
    CHECK(std::isnan(report.largest(&OsimFibreReport::length_other_frames_mm)));
}

TEST_CASE("Points that a bone carries are fixed, between them bodies take turns", "[io][osim_export]") {
    const TempDir folder;
    for (const int arc : {20, 21}) { // an odd and an even number of points that move
        WrappedRope rope;
        rope.arc = arc;
        const Timeline timeline = make_hinge_timeline(test::x_hinge(), 0.8, {40, 0, 0}, 2, {1});
        const RecordingPtr run = test::rope_run({"base", "block"}, timeline,
                                                {{"strap", rope.levels(), [=](int r, int level, int k) {
                                                      return rope.place(r, level, timeline.angle_rad(k));
                                                  }}});
        const OsimExportReport report = export_osim(folder.path() / "ropes.osim", *run);
        const LineModel model = read_osim_file(report.model).model;
        const std::vector<PathPoint>& points = model.muscles.at(0).points;
        REQUIRE(points.size() == 30);
        CHECK(report.fibres[0].moving_points == 20);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const bool fixed = i < 5 || i >= 25;
            INFO("arc " << arc << " point " << i);
            CHECK((points[i].kind == PathPointKind::fixed) == fixed);
            CHECK(points[i].name == "strap_f01-P" + std::to_string(i + 1));
            if (i > 0 && !(fixed && points[i - 1].kind == PathPointKind::fixed))
                CHECK(points[i].body != points[i - 1].body);
        }
        // What is read is what was meant, to the last digits.
        CHECK(model.skeleton.bodies[static_cast<std::size_t>(points[2].body)].name == "base");
        CHECK((points[2].location - in_model(rope.place(0, 2, 0))).norm() < 1e-12);
        CHECK(model.skeleton.bodies[static_cast<std::size_t>(points[27].body)].name == "block");
        CHECK((points.back().location - in_model(rope.place(0, rope.levels(), 0))).norm() < 1e-12);
    }
}

TEST_CASE("The report of an OpenSim model is what measuring the file again gives", "[io][osim_export]") {
    const TempDir folder;
    const RecordingPtr run = wrapped_run();
    const OsimExportReport report = export_osim(folder.path() / "ropes.osim", *run);
    const LineModel model = read_osim_file(report.model).model;
    const WrappedRope rope;
    for (int f = 0; f < 4; ++f) {
        double length = 0;
        for (int k = 0; k <= 40; ++k)
            length = std::max(
                length, std::abs(measured(model, f, 0.8 * k / 40).length_mm - rope.length(f, 0.8 * k / 40)));
        const OsimFibreReport& row = report.fibres[static_cast<std::size_t>(f)];
        CHECK(row.length_mm == Approx(length).margin(1e-7));
        CHECK(row.fibre == f);
        CHECK(row.opensim_moment_arm_mm == Approx(row.exact_moment_arm_mm).margin(1e-6));
    }
    const std::string table = read_file(report.table), facts = read_file(report.facts);
    CHECK(table.starts_with("muscle,fibre,name,points,moving_points,knots,length_difference_mm,"));
    CHECK(std::count(table.begin(), table.end(), '\n') == 5);
    CHECK(facts.find("\"summary\": \"4 fibres, 120 path points (80 moving, ") != std::string::npos);
    CHECK(report.summary.find('\n') == std::string::npos);
}

TEST_CASE("Straight fibres have two points and none that moves", "[io][osim_export]") {
    const TempDir folder;
    const Timeline timeline = make_hinge_timeline(test::x_hinge(), -0.9, {30, 0, 0}, 2, {1});
    const auto place = [=](int rope, int level, int k) {
        const Vec3 from(rope % 2 * 3.0, 40 + rope / 2 * 3.0, 80);
        const Vec3 to = timeline.bone_pose(1, k).apply(from + Vec3(0, -20, -150));
        return Vec3(from + (to - from) * level / 6.0);
    };
    const RecordingPtr run = test::rope_run({"base", "block"}, timeline, {{"strap", 6, place}});
    const OsimExportReport report = export_osim(folder.path() / "ropes.osim", *run);
    const LineModel model = read_osim_file(report.model).model;
    for (const LineMuscle& muscle : model.muscles) {
        CHECK(muscle.points.size() == 2);
        CHECK(std::all_of(muscle.points.begin(), muscle.points.end(),
                          [](const PathPoint& p) { return p.kind == PathPointKind::fixed; }));
    }
    CHECK(read_file(report.model).find("MovingPathPoint") == std::string::npos);
    CHECK(report.largest(&OsimFibreReport::length_mm) < 1e-6);
    // The coordinate goes up where the motion goes, whatever its sign: -0.9 about +x is +0.9 about Z.
    CHECK(model.skeleton.coordinates[0].range_max == Approx(0.9));
    CHECK((model.skeleton.joints.at(1).rotations.at(0).axis - Vec3::UnitZ()).norm() < 1e-15);
    const double length = (place(0, 6, 30) - place(0, 0, 30)).norm();
    CHECK(measured(model, 0, 0.9).length_mm == Approx(length).margin(1e-9));
}

TEST_CASE("A way back with other shapes is reported, not hidden", "[io][osim_export]") {
    const TempDir folder;
    const WrappedRope rope;
    const Timeline timeline = make_hinge_timeline(test::x_hinge(), 0.8, {40, 40, 0}, 2, {1});
    const auto place = [=](int r, int level, int k) {
        Vec3 p = rope.place(r, level, timeline.angle_rad(k));
        if (k > 40 && level > 4 && level < 4 + rope.arc) // 2 mm further out
            p += 2 * Vec3(0, p.y(), p.z()).normalized();
        return p;
    };
    const OsimExportReport report =
        export_osim(folder.path() / "ropes.osim",
                    *test::rope_run({"base", "block"}, timeline, {{"strap", rope.levels(), place}}));
    CHECK(report.fitted_frames == 41);
    CHECK(report.other_frames == 40);
    CHECK(report.largest(&OsimFibreReport::length_mm) < 0.2);
    CHECK(report.largest(&OsimFibreReport::length_other_frames_mm) > 3);
    CHECK(report.summary.find("in the 40 other frames the length differs by up to ") != std::string::npos);
}

TEST_CASE("Any motion of several bones becomes functions of its progress", "[io][osim_export]") {
    const TempDir folder;
    Timeline timeline;
    timeline.last_frame = 60;
    timeline.bone_tracks.resize(3);
    for (int k = 0; k <= 60; k += 4) {
        const double s = k / 60.0;
        Pose arm = rotation_about(Vec3(5, 0, 20), Vec3(1, 0.3, 0.2), 1.3 * std::sin(2 * s));
        arm = rotation_about(Vec3(0, 9, 0), Vec3(0, 1, 0.5), 0.6 * s * s).after(arm);
        arm.translation += Vec3(3 * s, 0, -8 * s * s);
        timeline.bone_tracks[1].keys.push_back({double(k), arm});
        timeline.bone_tracks[2].keys.push_back({double(k), Pose{Mat3::Identity(), Vec3(0, 20 * s, 0)}});
    }
    const auto place = [=](int rope, int level, int k) {
        const Vec3 rest(rope % 2 * 4.0, 30 + rope / 2 * 4.0, 60 - 12.0 * level);
        const double s = level / 10.0, blend = s * s * (3 - 2 * s);
        Vec3 p = (1 - blend) * rest + blend * timeline.bone_pose(1, k).apply(rest);
        p.x() += 6 * std::sin(std::numbers::pi * s) * std::sin(k / 20.0) * (level % 10 == 0 ? 0 : 1);
        return p;
    };
    const RecordingPtr run = test::rope_run({"base", "arm", "slide"}, timeline, {{"strap", 10, place}});
    CHECK_THROWS_WITH(
        export_osim(folder.path() / "ropes.osim", *run, {AxisMapping::lps_to_opensim, OsimCoordinate::joint}),
        Catch::Contains("hinge"));
    const OsimExportReport report = export_osim(folder.path() / "ropes.osim", *run);
    CHECK(report.coordinate == "progress");
    CHECK(report.fitted_frames == 61);
    CHECK(report.bone_mm < 0.01);
    CHECK(report.largest(&OsimFibreReport::length_mm) < 0.95);
    CHECK(report.largest(&OsimFibreReport::point_mm) < 0.95);
    CHECK(std::isnan(report.largest(&OsimFibreReport::moment_arm_mm)));
    const OsimModel back = read_osim_file(report.model);
    CHECK(back.notes.empty());
    CHECK(back.model.skeleton.coordinates.size() == 2);
    CHECK(back.model.skeleton.couplers.size() == 1);
    // The motion beside it takes the bones where they were.
    const StorageTable motion = read_storage_file(report.motion);
    CHECK(motion.row_count() == 61);
    const CoordinateColumns columns = match_coordinates(motion, back.model.skeleton);
    CHECK(columns.notes.empty());
    for (const int k : {0, 17, 60}) {
        std::vector<double> q;
        std::vector<Pose> poses;
        coordinate_values(motion, columns, static_cast<std::size_t>(k), back.model.skeleton, q);
        place_bodies(back.model.skeleton, q, poses);
        const int arm = back.model.skeleton.body_index("arm");
        const Vec3 corner(10, 12, 14);
        CHECK((poses[static_cast<std::size_t>(arm)].apply(in_model(corner)) -
               in_model(timeline.bone_pose(1, k).apply(corner)))
                  .norm() < 1e-5);
    }
}

TEST_CASE("Time stands in for a hinge's angle when that is wanted, and tells the way back, too",
          "[io][osim_export]") {
    const TempDir folder;
    OsimExportOptions options;
    options.coordinate = OsimCoordinate::time;
    const OsimExportReport report =
        export_osim(folder.path() / "ropes.osim", *wrapped_run({30, 30, 0}), options);
    CHECK(report.coordinate == "progress");
    CHECK(report.fitted_frames == 61);
    CHECK(report.other_frames == 0);
    CHECK(report.bone_mm < 0.01);
    CHECK(report.largest(&OsimFibreReport::length_mm) < 0.95);
}

TEST_CASE("The motion beside a hinge's model is in degrees and gives the run's angles", "[io][osim_export]") {
    const TempDir folder;
    const RecordingPtr run = wrapped_run({40, 20, 5});
    const OsimExportReport report = export_osim(folder.path() / "ropes.osim", *run);
    const StorageTable motion = read_storage_file(report.motion);
    CHECK(motion.in_degrees);
    CHECK(motion.columns == std::vector<std::string>{"time", "block_angle"});
    REQUIRE(motion.row_count() == 66);
    const LineModel model = read_osim_file(report.model).model;
    const CoordinateColumns columns = match_coordinates(motion, model.skeleton);
    std::vector<double> q;
    for (std::size_t k = 0; k < 66; ++k) {
        coordinate_values(motion, columns, k, model.skeleton, q);
        CHECK(q.at(0) == Approx(run->frame(static_cast<int>(k))->angle_rad).margin(1e-12));
    }
    CHECK(motion.value(10, 0) == Approx(10 * run->scene().parameters.get("solver.frame_time")));
}

TEST_CASE("Bone meshes lie beside the model, turned and not mirrored", "[io][osim_export]") {
    const TempDir folder;
    const RecordingPtr run = wrapped_run();
    for (const AxisMapping axes : {AxisMapping::lps_to_opensim, AxisMapping::as_is}) {
        OsimExportOptions options;
        options.axes = axes;
        const OsimExportReport report = export_osim(folder.path() / "ropes.osim", *run, options);
        const MeshFile mesh = read_mesh_file(folder.path() / "Geometry" / "block.vtp");
        CHECK(mesh.report.lines().empty());
        CHECK(signed_volume(mesh.mesh.positions, mesh.mesh.triangles) == Approx(10 * 12 * 14 * 1e-9));
        const Vec3 corner = run->scene().bones[1].mesh->positions[7];
        const Vec3 wanted = axes == AxisMapping::as_is ? Vec3(corner / 1000) : in_model(corner);
        CHECK((mesh.mesh.positions[7] - wanted).norm() < 1e-15);
        REQUIRE(mesh.point_arrays.size() == 1);
        CHECK(mesh.point_arrays[0].name == "Normals");
        CHECK(read_file(folder.path() / "Geometry" / "block.vtp").find("<PointData Normals=\"Normals\">") !=
              std::string::npos);
        const LineModel model = read_osim_file(report.model).model;
        const Body& block = model.skeleton.bodies[2];
        REQUIRE(block.meshes.size() == 1);
        CHECK(block.meshes[0].file == "block.vtp");
        CHECK(block.mass_kg == Approx(1900 * 10 * 12 * 14 * 1e-9));
        CHECK((block.mass_centre -
               (axes == AxisMapping::as_is ? Vec3(0.005, 0.006, 0.007) : in_model(Vec3(5, 6, 7))))
                  .norm() < 1e-12);
        // As OpenSim has it for a box about its centre.
        const double m = block.mass_kg, x = 0.01, y = 0.012, z = 0.014;
        if (axes == AxisMapping::as_is) {
            const std::string text = read_file(report.model);
            const std::size_t at = text.find("<inertia>", text.find("<Body name=\"block\">"));
            std::istringstream in(text.substr(at + 9));
            double xx = 0, yy = 0, zz = 0;
            in >> xx >> yy >> zz;
            CHECK(xx == Approx(m * (y * y + z * z) / 12));
            CHECK(yy == Approx(m * (x * x + z * z) / 12));
            CHECK(zz == Approx(m * (x * x + y * y) / 12));
        }
    }
}

TEST_CASE("Forces share the muscle's cross-section, lengths are those at rest", "[io][osim_export]") {
    const TempDir folder;
    const RecordingPtr run = wrapped_run();
    OsimExportOptions options;
    options.specific_tension = 30;
    const LineModel model =
        read_osim_file(export_osim(folder.path() / "ropes.osim", *run, options).model).model;
    const WrappedRope rope;
    double force = 0, lengths = 0;
    for (int f = 0; f < 4; ++f) {
        const LineMuscle& muscle = model.muscles[static_cast<std::size_t>(f)];
        CHECK(muscle.type == "Millard2012EquilibriumMuscle");
        CHECK(1000 * (muscle.optimal_fibre_length_m + muscle.tendon_slack_length_m) ==
              Approx(rope.length(f, 0)).epsilon(1e-9));
        CHECK(muscle.tendon_slack_length_m > 0);
        CHECK(muscle.pennation_rad == 0);
        CHECK(muscle.max_isometric_force_n == Approx(model.muscles[0].max_isometric_force_n));
        force += muscle.max_isometric_force_n;
        lengths += rope.length(f, 0) / 10;
    }
    const double volume_cm3 = std::abs(signed_volume(*run->frame(0)->muscle_positions[0],
                                                     run->scene().muscles[0].mesh->triangles)) /
                              1000;
    CHECK(force == Approx(30 * volume_cm3 / (lengths / 4)));
}

TEST_CASE("Names of any letters become legal and stay apart in an OpenSim model", "[io][osim_export]") {
    const TempDir folder;
    const WrappedRope rope;
    const Timeline timeline = make_hinge_timeline(test::x_hinge(), 0.8, {10, 0, 0}, 2, {1});
    const auto place = [=](int r, int level, int k) { return rope.place(r, level, timeline.angle_rad(k)); };
    const std::vector<RopeMuscle> muscles{{"gluteus \"maximus\" <1>", rope.levels(), place},
                                          {"gluteus 'maximus' /1/", rope.levels(), place},
                                          {"h\xc3\xbc"
                                           "ft muskel",
                                           rope.levels(), place},
                                          {"\xe7\xad\x8b", rope.levels(), place}};
    const RecordingPtr run = test::rope_run({"ground", "../fe mur & co"}, timeline, muscles);
    const OsimExportReport report = export_osim(folder.path() / "ropes.osim", *run);
    const LineModel model = read_osim_file(report.model).model;
    REQUIRE(model.muscles.size() == 16);
    std::set<std::string> names;
    for (const LineMuscle& muscle : model.muscles) {
        INFO(muscle.name);
        CHECK(muscle.name.find_first_not_of(
                  "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.") == std::string::npos);
        CHECK(names.insert(muscle.name).second);
    }
    CHECK(names.count("gluteus__maximus___1__f01") == 1);
    CHECK(names.count("gluteus__maximus___1__f01_2") == 1);
    CHECK(names.count("h_ft_muskel_f04") == 1);
    CHECK(names.count("muscle_f01") == 1);
    CHECK(model.skeleton.body_index("ground_2") > 0);
    CHECK(std::filesystem::exists(folder.path() / "Geometry" / "bone.._fe_mur___co.vtp"));
    CHECK(report.fibres[4].muscle == "gluteus 'maximus' /1/");
}

TEST_CASE("What can't be an OpenSim model is an error that leaves nothing", "[io][osim_export]") {
    const TempDir folder;
    const WrappedRope rope;
    const Timeline turning = make_hinge_timeline(test::x_hinge(), 0.8, {10, 0, 0}, 2, {1});
    const auto place = [=](int r, int level, int k) { return rope.place(r, level, turning.angle_rad(k)); };
    const std::vector<RopeMuscle> muscles{{"strap", rope.levels(), place}};
    const std::filesystem::path out = folder.path() / "out";
    CHECK_THROWS_WITH(
        export_osim(out / "ropes.osim", *test::rope_run({"base", "block"}, turning, muscles, false)),
        Catch::Contains("the run has no fibres") && Catch::Contains("fibres.method"));
    Timeline still = turning;
    still.bone_tracks.clear();
    still.angles.clear();
    CHECK_THROWS_WITH(export_osim(out / "ropes.osim", *test::rope_run({"base", "block"}, still, muscles)),
                      Catch::Contains("no bone moves"));
    const RecordingPtr run = test::rope_run({"base", "block"}, turning, muscles);
    std::atomic<bool> cancel{true};
    CHECK_THROWS_AS(export_osim(out / "ropes.osim", *run, {}, {{}, &cancel}), Cancelled);
    CHECK_FALSE(std::filesystem::exists(out));
    // An input is never replaced.
    Scene scene = run->scene();
    scene.bones[1].source.path = (out / "Geometry" / "block.vtp").string();
    Recording other(std::make_shared<const Scene>(scene));
    other.set_fibres(run->fibres());
    for (int k = 0; k < run->frame_count(); ++k)
        other.append(run->frame(k));
    CHECK_THROWS_WITH(export_osim(out / "ropes.osim", other), Catch::Contains("block.vtp"));
    CHECK_FALSE(std::filesystem::exists(out));
}

TEST_CASE("An OpenSim model is the same for any number of threads", "[io][osim_export]") {
    const TempDir folder;
    const RecordingPtr run = wrapped_run();
    OsimExportOptions options;
    const std::string one = read_file(export_osim(folder.path() / "ropes.osim", *run, options).model);
    options.threads = 3;
    CHECK(read_file(export_osim(folder.path() / "ropes.osim", *run, options).model) == one);
}
