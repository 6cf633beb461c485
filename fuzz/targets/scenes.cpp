// What is read onto a scene: areas, outlines, motions.

#include "fascicle/io/area_file.hpp"
#include "fascicle/io/attachment_file.hpp"
#include "fascicle/io/mesh_file.hpp"
#include "fascicle/io/motion_file.hpp"
#include "fascicle/io/storage_write.hpp"
#include "fascicle/io/table_motion.hpp"
#include "fascicle/scene/outline_areas.hpp"
#include "fuzz/check.hpp"
#include "fuzz/targets.hpp"

#include <cmath>
#include <sstream>

namespace fascicle::fuzz {
namespace {

/// The octahedron about the origin, of radius 10.
MeshPtr octahedron() {
    return std::make_shared<const TriMesh>(TriMesh{
        {Vec3(10, 0, 0), Vec3(-10, 0, 0), Vec3(0, 10, 0), Vec3(0, -10, 0), Vec3(0, 0, 10), Vec3(0, 0, -10)},
        {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}});
}

Scene two_bones() {
    Scene scene;
    scene.bones = {{"pelvis", octahedron(), {}}, {"femur", octahedron(), {}}};
    scene.unit = LengthUnit::millimetre;
    return scene;
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

void fuzz_area_mesh(std::string_view bytes) {
    static const Scene scene = [] {
        Scene made;
        const TriMesh bone{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)},
                           {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
        made.bones = {{"bone", std::make_shared<const TriMesh>(bone), {}}};
        return made;
    }();
    reads("fuzz.vtp", [&] {
        MeshFile file = read_mesh_bytes(bytes, "fuzz.vtp");
        MeshData data;
        data.mesh = std::move(file.mesh);
        data.point_arrays = std::move(file.point_arrays);
        Scene marked = scene;
        marked.muscles.resize(1);
        marked.muscles[0].name = "m";
        marked.muscles[0].areas = areas_from_mesh(data, "fuzz.vtp", scene, 0, "m");
        for (const AttachmentArea& area : marked.muscles[0].areas)
            FUZZ_CHECK(area.bone == 0 && area.vertices.vertex_count() == 4);
        const MeshData back = area_mesh(marked, 0, 0);
        const std::vector<AttachmentArea> again = areas_from_mesh(back, "again", scene, 0, "m");
        FUZZ_CHECK(again.size() == marked.muscles[0].areas.size());
        for (std::size_t i = 0; i < again.size(); ++i) // heads are numbered anew: without gaps
            FUZZ_CHECK(again[i].vertices == marked.muscles[0].areas[i].vertices &&
                       again[i].kind == marked.muscles[0].areas[i].kind);
    });
}

void fuzz_attachment_areas(std::string_view bytes) {
    static const Scene scene = two_bones();
    static BoneSurfaces surfaces;
    Muscle muscle;
    muscle.name = "fuzz.csv";
    reads("fuzz.csv", [&] {
        muscle.outlines = read_attachments(bytes, "fuzz.csv", scene.unit);
        std::vector<std::string> notes;
        for (const AttachmentArea& area : areas_from_outlines(scene, muscle, surfaces, notes))
            FUZZ_CHECK(area.bone >= 0 && area.bone < 2 && area.vertices.vertex_count() == 6);
    });
}

void fuzz_motion_csv(std::string_view bytes) {
    static const Scene scene = two_bones();
    reads("fuzz.csv", [&] {
        const Timeline timeline = read_motion(bytes, "fuzz.csv", scene);
        FUZZ_CHECK(timeline.last_frame >= 1 && timeline.last_frame <= 3'000'000);
        FUZZ_CHECK(timeline.bone_tracks.size() <= scene.bones.size());
        for (const BoneTrack& track : timeline.bone_tracks)
            for (std::size_t k = 0; k < track.keys.size(); ++k) {
                const PoseKey& key = track.keys[k];
                FUZZ_CHECK(k == 0 || key.frame > track.keys[k - 1].frame);
                FUZZ_CHECK(key.pose.translation.allFinite());
                FUZZ_CHECK((key.pose.rotation * key.pose.rotation.transpose() - Mat3::Identity()).norm() <
                           1e-6);
            }
        for (const double frame : {0.0, 0.5, 1.0, timeline.last_frame / 2.0, double(timeline.last_frame)}) {
            for (int bone = 0; bone < 2; ++bone)
                FUZZ_CHECK(timeline.bone_pose(bone, frame).rotation.allFinite());
            FUZZ_CHECK(std::isfinite(timeline.angle_rad(frame)));
        }
    });
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

std::vector<Target> scene_targets() {
    return {
        {"area_mesh", fuzz_area_mesh, 4 * kB, "mesh_vtp", "area_mesh", 400, 400 * MB}, // packed data of VTP
        {"attachment_areas", fuzz_attachment_areas, 2 * kB, "attachment_csv", "attachment_csv", 400, 4 * MB},
        {"motion_csv", fuzz_motion_csv, 2 * kB, "motion_csv", "motion_csv", 400, MB},
        {"storage", fuzz_storage, 2 * kB, "storage", "storage", 400, 4 * MB},
    };
}

} // namespace fascicle::fuzz
