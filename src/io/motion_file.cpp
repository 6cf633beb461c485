#include "fascicle/io/motion_file.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/base/param_table.hpp"
#include "fascicle/base/pose.hpp"
#include "fascicle/base/suggest.hpp"
#include "fascicle/io/csv.hpp"
#include "fascicle/motion/joint_track.hpp"
#include "io/formats/text_scanner.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace fascicle {
namespace {

constexpr double last_frame_allowed = 3e6; // as in projects
constexpr double most_degrees = 3600;      // ten turns: what a mistyped number is not, and few keys a row
constexpr double tolerance = 1e-6;         // what is left of a rotation that was written with seven digits
constexpr const char* expected_header =
    "a header row frame,bone,m00,m01,...,m23 or frame,bone,cx,cy,cz,ax,ay,az,angle_deg";

/// A key of one bone as the file has it. Of matrices `turns` stays empty, of turns `pose` is not used.
struct FileKey {
    std::size_t place = 0; ///< of its first row
    JointKey joint;
    Pose pose;
};

struct Columns {
    int frame = -1, bone = -1, angle = -1;
    std::array<int, 12> matrix{};
    std::array<int, 6> line{}; ///< centre, axis
    double centre_scale = 1;   ///< of a value to scene units
    bool matrices = false;
};

Columns find_columns(const CsvReader& csv, LengthUnit unit) {
    std::vector<std::string> names;
    for (const std::string& name : csv.columns())
        names.push_back(plain_column(name));
    const auto find = [&](const std::string& name) {
        const auto it = std::find(names.begin(), names.end(), name);
        return it == names.end() ? -1 : static_cast<int>(it - names.begin());
    };
    const auto need = [&](const std::string& name) {
        if (find(name) < 0)
            csv.fail("the header lacks column '" + name + "'", expected_header);
        return find(name);
    };
    Columns columns;
    columns.frame = need("frame");
    columns.bone = need("bone");
    columns.matrices = find("m00") >= 0;
    columns.angle = find("angle_deg");
    if (columns.matrices && columns.angle >= 0)
        csv.fail("the header has both m00 and angle_deg", expected_header);
    if (columns.matrices) {
        for (std::size_t i = 0; i < 12; ++i)
            columns.matrix[i] = need({'m', static_cast<char>('0' + i / 4), static_cast<char>('0' + i % 4)});
        return columns;
    }
    if (columns.angle < 0)
        csv.fail("the header has neither m00 nor angle_deg", expected_header);
    const double scene_mm = millimetres_per_unit(unit);
    const std::pair<const char*, double> units[] = {
        {"_mm", 1.0}, {"_cm", 10.0}, {"_m", 1000.0}, {"", scene_mm}};
    const auto used = std::find_if(std::begin(units), std::end(units) - 1, [&](const auto& suffix) {
        return find(std::string("cx") + suffix.first) >= 0;
    });
    columns.centre_scale = used->second / scene_mm;
    for (std::size_t i = 0; i < 3; ++i) {
        columns.line[i] = need(std::string{'c', "xyz"[i]} + used->first);
        columns.line[3 + i] = need({'a', "xyz"[i]});
    }
    return columns;
}

/// The nearest rotation; unchanged, to the last bit, where only rounding is amiss.
Mat3 clean_rotation(const CsvReader& csv, const Mat3& m) {
    const double error = (m * m.transpose() - Mat3::Identity()).cwiseAbs().maxCoeff();
    if (!(error <= tolerance)) // true for NaN, too
        csv.fail("the 3x3 part is no rotation", "columns of length 1 at right angles, to 1e-6");
    if (!(m.determinant() > 0))
        csv.fail("the 3x3 part is a reflection", "a rotation, of determinant 1");
    if (error <= 1e-14)
        return m;
    const Eigen::JacobiSVD<Mat3> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
    return svd.matrixU() * svd.matrixV().transpose();
}

Pose read_pose(const CsvReader& csv, const Columns& columns) {
    Pose pose;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column)
            pose.rotation(row, column) =
                csv.number(columns.matrix[static_cast<std::size_t>(4 * row + column)]);
        pose.translation[row] = csv.number(columns.matrix[static_cast<std::size_t>(4 * row + 3)]);
    }
    pose.rotation = clean_rotation(csv, pose.rotation);
    return pose;
}

JointTurn read_turn(const CsvReader& csv, const Columns& columns) {
    JointTurn turn;
    for (int k = 0; k < 3; ++k) {
        turn.centre[k] = columns.centre_scale * csv.number(columns.line[static_cast<std::size_t>(k)]);
        turn.axis[k] = csv.number(columns.line[static_cast<std::size_t>(3 + k)]);
    }
    if (!has_direction(turn.axis))
        csv.fail("the axis has no direction", "ax,ay,az other than 0,0,0");
    turn.axis.normalize();
    const double degrees = csv.number(columns.angle);
    if (std::abs(degrees) > most_degrees)
        csv.fail("the angle is " + csv.cell(columns.angle), "-3600 to 3600 degrees");
    turn.angle_rad = degrees * std::numbers::pi / 180.0;
    return turn;
}

int bone_of_row(const CsvReader& csv, int column, const Scene& scene) {
    const std::string& name = csv.cell(column);
    const int bone = scene.bone_index(name);
    if (bone >= 0)
        return bone;
    std::vector<std::string> names;
    std::string known;
    for (const Bone& b : scene.bones) {
        names.push_back(b.name);
        known += (known.empty() ? "" : ", ") + b.name;
    }
    csv.fail(name.empty() ? "no bone" : "there is no bone " + io::shown(name) + did_you_mean(name, names),
             known.empty() ? "no rows: the scene has no bones" : "one of " + known);
}

double frame_of_row(const CsvReader& csv, int column) {
    const double frame = csv.number(column);
    if (!(frame >= 0 && frame <= last_frame_allowed))
        csv.fail("frame is " + io::shown(csv.cell(column)), "a number from 0 to 3000000");
    return frame;
}

using BoneKeys = std::vector<std::vector<FileKey>>; ///< per bone

BoneKeys read_keys(CsvReader& csv, const Columns& columns, const Scene& scene) {
    BoneKeys bones(scene.bones.size());
    while (csv.next_row()) {
        auto& keys = bones[static_cast<std::size_t>(bone_of_row(csv, columns.bone, scene))];
        const double frame = frame_of_row(csv, columns.frame);
        const bool again = !keys.empty() && keys.back().joint.frame == frame;
        if (!keys.empty() && frame < keys.back().joint.frame)
            csv.fail("frame " + csv.cell(columns.frame) + " of bone '" + csv.cell(columns.bone) +
                         "' comes after frame " + number_text(keys.back().joint.frame),
                     "ascending frames for each bone");
        if (again && columns.matrices)
            csv.fail("frame " + csv.cell(columns.frame) + " of bone '" + csv.cell(columns.bone) +
                         "' is there twice",
                     "one row a frame and bone");
        if (!again)
            keys.push_back({csv.row_place(), {frame, {}}, {}});
        if (columns.matrices)
            keys.back().pose = read_pose(csv, columns);
        else
            keys.back().joint.turns.push_back(read_turn(csv, columns));
    }
    return bones;
}

void check(const CsvReader& csv, KeyStep step, const FileKey& key, const std::string& bone) {
    const std::string what = "bone '" + bone + "' turns by 180 degrees or more ";
    if (step == KeyStep::ambiguous)
        csv.fail_at(key.place, what + "since the key before, about an axis that is not told",
                    "a key in between");
    if (step == KeyStep::too_fast)
        csv.fail_at(key.place, what + "a frame", "more frames, or smaller angles");
}

BoneTrack track_of(const CsvReader& csv, bool matrices, const std::vector<FileKey>& keys,
                   const std::string& bone) {
    BoneTrack track;
    if (keys.empty())
        return track;
    track.keys.push_back({0, Pose{}});
    JointKey last{0, {}};
    for (const FileKey& key : keys) {
        const Pose pose = matrices ? key.pose : pose_of(key.joint.turns);
        if (!pose.translation.allFinite())
            csv.fail_at(key.place, "the motion of bone '" + bone + "' overflows", "smaller coordinates");
        if (key.joint.frame == 0.0) { // rest, whatever its last digits say
            if (!((pose.rotation - Mat3::Identity()).norm() <= tolerance &&
                  pose.translation.norm() <= tolerance))
                csv.fail_at(key.place, "bone '" + bone + "' is not at rest in frame 0",
                            "the first pose at frame 1 or later: the bones' files hold the rest pose");
            continue;
        }
        if (!matrices) {
            check(csv, append_joint_key(track, last, key.joint), key, bone);
            last = key.joint;
            continue;
        }
        const PoseKey next{key.joint.frame, pose};
        check(csv, check_step(track.keys.back(), next), key, bone);
        track.keys.push_back(next);
    }
    return track;
}

/// One joint angle for all bones that the file names, where it has one.
void find_angle(const BoneKeys& bones, Timeline& timeline) {
    const std::vector<FileKey>* first = nullptr;
    const auto same = [](const FileKey& a, const FileKey& b) {
        return a.joint.frame == b.joint.frame && same_axes(a.joint, b.joint) &&
               a.joint.turns[0].angle_rad == b.joint.turns[0].angle_rad;
    };
    for (const auto& keys : bones) {
        if (keys.empty())
            continue;
        if (!std::all_of(keys.begin(), keys.end(), [&](const FileKey& key) {
                return key.joint.turns.size() == 1 && same_axes(key.joint, keys.front().joint);
            }))
            return;
        if (first == nullptr)
            first = &keys;
        else if (!std::equal(first->begin(), first->end(), keys.begin(), keys.end(), same))
            return;
    }
    if (first == nullptr)
        return;
    const JointTurn& joint = first->front().joint.turns.front();
    timeline.hinge = Hinge{joint.centre, joint.axis};
    timeline.angles.push_back({0, 0});
    for (const FileKey& key : *first)
        if (key.joint.frame > 0)
            timeline.angles.push_back({key.joint.frame, key.joint.turns[0].angle_rad});
}

} // namespace

Timeline read_motion(std::string_view bytes, const std::string& file, const Scene& scene) {
    CsvReader csv(bytes, file);
    const Columns columns = find_columns(csv, scene.unit);
    const BoneKeys keys = read_keys(csv, columns, scene);
    Timeline timeline;
    double last_frame = -1;
    for (std::size_t b = 0; b < keys.size(); ++b) {
        timeline.bone_tracks.push_back(track_of(csv, columns.matrices, keys[b], scene.bones[b].name));
        for (const PoseKey& key : timeline.bone_tracks.back().keys) // those between the keys of the file, too
            if (!key.pose.translation.allFinite())
                throw_error(file, "the motion of bone '" + scene.bones[b].name + "' overflows",
                            "smaller coordinates");
        if (!keys[b].empty())
            last_frame = std::max(last_frame, keys[b].back().joint.frame);
    }
    if (last_frame < 0)
        throw_error(file, "the table has no rows", "poses of bones");
    if (last_frame == 0.0)
        throw_error(file, "the motion ends at frame 0", "a key at frame 1 or later");
    timeline.last_frame = static_cast<int>(std::ceil(last_frame));
    if (!columns.matrices)
        find_angle(keys, timeline);
    return timeline;
}

} // namespace fascicle
