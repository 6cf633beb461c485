// Tables of comma-separated values.

#include "fascicle/io/attachment_file.hpp"
#include "fascicle/io/csv.hpp"
#include "fascicle/io/motion_file.hpp"
#include "fascicle/scene/outline_areas.hpp"
#include "fuzz/check.hpp"
#include "fuzz/targets.hpp"

#include <cmath>
#include <sstream>

namespace fascicle::fuzz {
namespace {

using Rows = std::vector<std::vector<std::string>>;

Rows all_rows(std::string_view bytes, const std::string& name) {
    CsvReader csv(bytes, name);
    Rows rows;
    rows.push_back(csv.columns());
    while (csv.next_row()) {
        rows.emplace_back().reserve(csv.columns().size());
        for (int c = 0; c < static_cast<int>(csv.columns().size()); ++c)
            rows.back().push_back(csv.cell(c));
    }
    return rows;
}

/// Whether a table has these rows; one at a time, so that memory is the reader's, not that of a second copy.
bool has_rows(std::string_view bytes, const Rows& rows) {
    CsvReader csv(bytes, "written");
    if (csv.columns() != rows.front())
        return false;
    std::size_t row = 1;
    for (; csv.next_row(); ++row) {
        if (row == rows.size() || rows[row].size() != csv.columns().size())
            return false;
        for (std::size_t c = 0; c < rows[row].size(); ++c)
            if (csv.cell(static_cast<int>(c)) != rows[row][c])
                return false;
    }
    return row == rows.size();
}

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

void fuzz_csv(std::string_view bytes) {
    Rows rows;
    if (!reads("fuzz.csv", [&] { rows = all_rows(bytes, "fuzz.csv"); }))
        return;
    std::ostringstream out;
    CsvWriter csv(out);
    for (const auto& row : rows) {
        for (const std::string& cell : row)
            csv.text(cell);
        csv.end_row();
    }
    const std::string text = std::move(out).str();
    bool names = false; // a header without a name is no header
    for (const std::string& name : rows.front())
        names = names || !name.empty();
    if (names)
        FUZZ_CHECK(has_rows(text, rows));
    reads("fuzz.csv", [&] {
        CsvReader numbers(bytes, "fuzz.csv");
        while (numbers.next_row())
            for (int c = 0; c < static_cast<int>(numbers.columns().size()); ++c)
                FUZZ_CHECK(std::isfinite(numbers.number(c)));
    });
    for (const std::string& name : rows.front())
        plain_column(name);
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

void fuzz_attachment_csv(std::string_view bytes) {
    for (const LengthUnit unit : {LengthUnit::millimetre, LengthUnit::metre})
        reads("fuzz.csv", [&] {
            const std::vector<AttachmentOutline> outlines = read_attachments(bytes, "fuzz.csv", unit);
            FUZZ_CHECK(!outlines.empty());
            for (const AttachmentOutline& outline : outlines) {
                FUZZ_CHECK(outline.kind != AttachmentKind::unknown && !outline.bone.empty());
                FUZZ_CHECK(!outline.points.empty());
                for (const Vec3& p : outline.points)
                    FUZZ_CHECK(p.allFinite());
            }
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

} // namespace

std::vector<Target> table_targets() {
    constexpr std::size_t kB = 1024, MB = 1024 * kB;
    return {
        {"csv", fuzz_csv, 1 * kB, "csv", "csv", 400, MB},
        {"motion_csv", fuzz_motion_csv, 2 * kB, "motion_csv", "motion_csv", 400, MB},
        {"attachment_csv", fuzz_attachment_csv, 2 * kB, "attachment_csv", "attachment_csv", 400, MB},
        {"attachment_areas", fuzz_attachment_areas, 2 * kB, "attachment_csv", "attachment_csv", 400, 4 * MB},
    };
}

} // namespace fascicle::fuzz
