// OpenSim's models and tables over time.

#include "fascicle/anatomy/line_measure.hpp"
#include "fascicle/io/osim_file.hpp"
#include "fascicle/io/storage_write.hpp"
#include "fascicle/io/table_motion.hpp"
#include "fuzz/check.hpp"
#include "fuzz/targets.hpp"

#include <cmath>
#include <sstream>

namespace fascicle::fuzz {
namespace {

void check_model(const LineModel& model) {
    const Skeleton& skeleton = model.skeleton;
    const auto is_body = [&](int b) { return b >= 0 && b < static_cast<int>(skeleton.bodies.size()); };
    const auto is_coordinate = [&](int c) {
        return c >= 0 && c < static_cast<int>(skeleton.coordinates.size());
    };
    for (const Coordinate& c : skeleton.coordinates)
        FUZZ_CHECK(std::isfinite(c.default_value));
    for (const Joint& joint : skeleton.joints) {
        FUZZ_CHECK(is_body(joint.parent) && is_body(joint.child));
        for (const auto* axes : {&joint.rotations, &joint.translations})
            for (const JointAxis& axis : *axes)
                FUZZ_CHECK(std::abs(axis.axis.norm() - 1) < 1e-9);
    }
    for (const CoordinateCoupler& coupler : skeleton.couplers)
        FUZZ_CHECK(is_coordinate(coupler.dependent));
    for (const WrapObject& object : model.wrap_objects)
        FUZZ_CHECK(is_body(object.body));
    for (const LineMuscle& muscle : model.muscles) {
        FUZZ_CHECK(muscle.points.size() >= 2);
        for (const PathPoint& point : muscle.points)
            FUZZ_CHECK(is_body(point.body) &&
                       (point.kind != PathPointKind::conditional || is_coordinate(point.coordinate)));
        for (const PathWrap& wrap : muscle.wraps)
            FUZZ_CHECK(wrap.object >= 0 && wrap.object < static_cast<int>(model.wrap_objects.size()) &&
                       wrap.first >= 0 && wrap.last < static_cast<int>(muscle.points.size()));
    }
}

/// An arm that turns about z on a base: coordinate "hip_flexion_r", translation "slide".
LineMuscles arm() {
    auto model = std::make_shared<LineModel>();
    Skeleton& skeleton = model->skeleton;
    skeleton.bodies.push_back({"arm", 0, Vec3::Zero(), {}});
    Coordinate turn, slide;
    turn.name = "hip_flexion_r";
    slide.name = "slide";
    slide.kind = CoordinateKind::translational;
    skeleton.coordinates = {turn, slide};
    Joint joint;
    joint.name = "hip";
    joint.child = 1;
    joint.rotations = {{Vec3::UnitZ(), {{{0, 1.0}}, JointFunction::linear(1, 0)}}};
    joint.translations = {{Vec3::UnitX(), {{{1, 1.0}}, JointFunction::linear(1, 0)}}};
    skeleton.joints = {joint};
    arrange_skeleton(skeleton, "arm");
    LineMuscles lines;
    lines.rest.assign(2, Pose{});
    lines.bone_of_body = {"base", "arm"};
    lines.rest_values.assign(2, 0.0);
    lines.model = model;
    return lines;
}

void fuzz_osim(std::string_view bytes) {
    OsimModel file;
    if (!reads("fuzz.osim", [&] { file = read_osim(bytes, "fuzz.osim"); }))
        return;
    const LineModel& model = file.model;
    check_model(model);
    const std::vector<double> values = model.skeleton.default_values();
    Posture posture;
    set_posture(model.skeleton, values, posture);
    FUZZ_CHECK(posture.poses.size() == model.skeleton.bodies.size());
    LinePathSolver solver(model);
    for (int m = 0; m < std::min(4, static_cast<int>(model.muscles.size())); ++m)
        measure_line(solver, m, values.empty() ? -1 : 0, posture);
}

void fuzz_storage(std::string_view bytes) {
    static const LineMuscles lines = arm();
    static const Scene scene = [] {
        Scene made;
        const auto mesh = std::make_shared<const TriMesh>();
        made.bones = {{"base", mesh, {}}, {"arm", mesh, {}}};
        return made;
    }();
    StorageTable table;
    if (!reads("fuzz.mot", [&] { table = read_storage(bytes, "fuzz.mot"); }))
        return;
    FUZZ_CHECK(table.row_count() > 0 && !table.columns.empty());
    FUZZ_CHECK(table.values.size() == table.row_count() * table.columns.size());
    for (std::size_t i = 0; i < table.lines.size(); ++i)
        FUZZ_CHECK(table.lines[i] >= 1 && (i == 0 || table.lines[i] > table.lines[i - 1]));
    std::ostringstream out;
    write_storage(out, table);
    const StorageTable back = read_storage(out.str(), "written");
    FUZZ_CHECK(back.columns == table.columns && back.in_degrees == table.in_degrees);
    std::ostringstream again;
    write_storage(again, back);
    FUZZ_CHECK(again.str() == out.str());
    for (const int lead_in : {0, 3}) {
        const TableTiming timing{0.1, lead_in};
        reads("fuzz.mot", [&] {
            const int frames = frame_count(table, timing);
            FUZZ_CHECK(frames >= 1);
            if (frames > 1000)
                return; // a short file may ask for 100,000, which is slow, not wrong
            const std::vector<AngleKey> angles =
                column_angles(table, static_cast<int>(table.columns.size()) - 1, 0.01, timing);
            FUZZ_CHECK(angles.front().frame == 0 && angles.back().frame == frames);
            std::vector<std::string> notes;
            const Timeline timeline =
                model_timeline(table, lines, lines.bone_of_body, 0, scene, timing, notes);
            FUZZ_CHECK(timeline.last_frame == frames);
            for (const PoseKey& key : timeline.bone_tracks.at(1).keys)
                FUZZ_CHECK(key.pose.rotation.allFinite() && key.pose.translation.allFinite());
        });
    }
}

} // namespace

std::vector<Target> opensim_targets() {
    constexpr std::size_t kB = 1024, MB = 1024 * kB;
    return {
        {"osim", fuzz_osim, 8 * kB, "osim", "osim", 400, 4 * MB},
        {"storage", fuzz_storage, 2 * kB, "storage", "storage", 400, 4 * MB},
    };
}

} // namespace fascicle::fuzz
