// Keys of single bones, and the joint angle that goes with them.
#include "fascicle/base/error.hpp"
#include "fascicle/document/actions/timeline_actions.hpp"
#include "fascicle/motion/joint_track.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace fascicle::actions {

namespace {

constexpr double most_frames = 1e6;
constexpr double same_to = 1e-6; ///< rotations; shifts relative to the scene's reach

bool nearly(const Pose& a, const Pose& b) {
    const double reach = 1 + std::max(a.translation.norm(), b.translation.norm());
    return (a.rotation - b.rotation).norm() < same_to &&
           (a.translation - b.translation).norm() < same_to * reach;
}

bool turns_with_joint(const Timeline& timeline, const BoneTrack& track) {
    return std::all_of(track.keys.begin(), track.keys.end(), [&](const PoseKey& key) {
        return nearly(key.pose, rotation_about(timeline.hinge->centre, timeline.hinge->axis,
                                               timeline.angle_rad(key.frame)));
    });
}

/// About one axis, without a slide: its angles, by the right-hand rule about the axis of the widest turn.
bool find_joint(Timeline& timeline, const BoneTrack& track) {
    Screw widest;
    for (const PoseKey& key : track.keys)
        if (const Screw screw = screw_of(key.pose, Vec3::Zero()); screw.angle_rad > widest.angle_rad)
            widest = screw;
    if (!(widest.angle_rad > 0))
        return false;
    std::vector<AngleKey> angles;
    for (const PoseKey& key : track.keys) {
        const Screw screw = screw_of(key.pose, widest.centre);
        const double angle = screw.axis.dot(widest.axis) < 0 ? -screw.angle_rad : screw.angle_rad;
        if (!nearly(key.pose, rotation_about(widest.centre, widest.axis, angle)))
            return false;
        angles.push_back({key.frame, angle});
    }
    timeline.hinge = Hinge{widest.centre, widest.axis};
    timeline.angles = std::move(angles);
    return true;
}

bool same_keys(const BoneTrack& a, const BoneTrack& b) {
    return std::equal(
        a.keys.begin(), a.keys.end(), b.keys.begin(), b.keys.end(),
        [](const PoseKey& x, const PoseKey& y) { return x.frame == y.frame && nearly(x.pose, y.pose); });
}

/// Keeps, finds anew, or drops the joint of a timeline whose keys have changed.
void follow_keys(Timeline& timeline) {
    std::vector<const BoneTrack*> moving;
    for (const BoneTrack& track : timeline.bone_tracks)
        if (track.moves())
            moving.push_back(&track);
    if (timeline.hinge && std::all_of(moving.begin(), moving.end(), [&](const BoneTrack* track) {
            return turns_with_joint(timeline, *track);
        }))
        return;
    timeline.hinge.reset();
    timeline.angles.clear();
    if (!moving.empty() && std::all_of(moving.begin(), moving.end(), [&](const BoneTrack* track) {
            return same_keys(*track, *moving.front());
        }))
        find_joint(timeline, *moving.front());
}

std::string frame_name(double frame) {
    const auto whole = static_cast<long long>(frame);
    return double(whole) == frame ? std::to_string(whole) : std::to_string(frame);
}

void require_frame(double frame) {
    if (!(frame >= 1 && frame <= most_frames))
        throw_error("frame", frame_name(frame) + " cannot have a key", "a number from 1 to 1000000",
                    ErrorKind::usage);
}

void require_steps(const BoneTrack& track, const std::string& bone) {
    for (std::size_t i = 1; i < track.keys.size(); ++i)
        if (check_step(track.keys[i - 1], track.keys[i]) != KeyStep::good)
            throw_error(bone,
                        "it would turn by half a turn or more between frames " +
                            frame_name(track.keys[i - 1].frame) + " and " + frame_name(track.keys[i].frame),
                        "a key in between, or a smaller angle", ErrorKind::usage);
}

/// The timeline with a changed and checked track of a bone.
template <class Change>
Timeline changed_timeline(const Document& document, int bone, Change change) {
    FASCICLE_ASSERT(bone >= 0 && bone < static_cast<int>(document.scene().bones.size()));
    const auto b = static_cast<std::size_t>(bone);
    const std::string name = document.scene().bones[b].name;
    Timeline timeline = document.scene().timeline;
    if (timeline.bone_tracks.size() <= b)
        timeline.bone_tracks.resize(b + 1);
    BoneTrack& track = timeline.bone_tracks[b];
    if (track.keys.empty())
        track.keys.push_back({0, Pose{}});
    change(track);
    require_steps(track, name);
    if (!track.moves() && track.keys.size() == 1)
        track.keys.clear();
    if (!track.keys.empty())
        timeline.last_frame =
            std::max(timeline.last_frame, static_cast<int>(std::ceil(track.keys.back().frame)));
    follow_keys(timeline);
    return timeline;
}

template <class Change>
void change_track(Document& document, int bone, const std::string& what, Change change) {
    Timeline timeline = changed_timeline(document, bone, change);
    const std::string name = document.scene().bones[static_cast<std::size_t>(bone)].name;
    set_timeline(document, std::move(timeline), {}, what + ", " + name);
}

void insert_sorted(BoneTrack& track, const PoseKey& key) {
    const auto at = std::lower_bound(track.keys.begin(), track.keys.end(), key.frame,
                                     [](const PoseKey& k, double f) { return k.frame < f; });
    if (at != track.keys.end() && at->frame == key.frame)
        *at = key;
    else
        track.keys.insert(at, key);
}

} // namespace

Screw screw_of(const Pose& pose, const Vec3& near) {
    Screw screw;
    const Eigen::AngleAxisd turn(pose.rotation);
    screw.angle_rad = std::abs(turn.angle());
    if (screw.angle_rad < 1e-12) {
        screw.angle_rad = 0;
        screw.slide = pose.translation.norm();
        if (screw.slide > 0)
            screw.axis = pose.translation / screw.slide;
        screw.centre = near;
        return screw;
    }
    screw.axis = turn.angle() < 0 ? Vec3(-turn.axis()) : Vec3(turn.axis());
    screw.slide = pose.translation.dot(screw.axis);
    // Across the axis c - R c = t': c = (t' + cot(angle / 2) axis x t') / 2.
    const Vec3 across = pose.translation - screw.slide * screw.axis;
    const Vec3 c = 0.5 * (across + screw.axis.cross(across) / std::tan(screw.angle_rad / 2));
    screw.centre = c + screw.axis * screw.axis.dot(near - c);
    return screw;
}

Pose pose_of(const Screw& screw) {
    const double length = screw.axis.norm();
    if (!(length > 0) || !std::isfinite(length) || !screw.centre.allFinite() ||
        !std::isfinite(screw.angle_rad) || !std::isfinite(screw.slide))
        throw_error("axis", "it has no direction, or a number is not finite", "a direction",
                    ErrorKind::usage);
    const Vec3 axis = screw.axis / length;
    Pose pose = screw.angle_rad == 0 ? Pose{} : rotation_about(screw.centre, axis, screw.angle_rad);
    pose.translation += screw.slide * axis;
    return pose;
}

void set_pose_key(Document& document, int bone, double frame, const Pose& pose) {
    require_frame(frame);
    change_track(document, bone, "Set key", [&](BoneTrack& track) { insert_sorted(track, {frame, pose}); });
}

void edit_pose_key(Document& document, int bone, std::size_t key, const Pose& pose) {
    Timeline timeline = changed_timeline(document, bone, [&](BoneTrack& track) {
        FASCICLE_ASSERT(key > 0 && key < track.keys.size());
        track.keys[key].pose = pose;
    });
    Scene& scene = document.edit();
    scene.timeline = std::move(timeline);
    scene.motion_source = {};
}

void move_pose_key(Document& document, int bone, std::size_t key, double frame) {
    require_frame(frame);
    change_track(document, bone, "Move key", [&](BoneTrack& track) {
        FASCICLE_ASSERT(key > 0 && key < track.keys.size());
        const PoseKey moved{frame, track.keys[key].pose};
        track.keys.erase(track.keys.begin() + static_cast<std::ptrdiff_t>(key));
        if (std::any_of(track.keys.begin(), track.keys.end(),
                        [&](const PoseKey& other) { return other.frame == frame; }))
            throw_error("frame", frame_name(frame) + " has a key already", "a free frame", ErrorKind::usage);
        insert_sorted(track, moved);
    });
}

void remove_pose_key(Document& document, int bone, std::size_t key) {
    change_track(document, bone, "Remove key", [&](BoneTrack& track) {
        FASCICLE_ASSERT(key > 0 && key < track.keys.size());
        track.keys.erase(track.keys.begin() + static_cast<std::ptrdiff_t>(key));
    });
}

bool set_last_frame(Document& document, int last_frame) {
    require_frame(last_frame);
    if (document.scene().timeline.last_frame == last_frame)
        return false;
    document.edit().timeline.last_frame = last_frame;
    return document.commit("Set length");
}

} // namespace fascicle::actions
