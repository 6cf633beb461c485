#include "fascicle/document/actions/timeline_actions.hpp"

#include "document/actions/hinge_track.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/base/pose.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fascicle::actions {

namespace {

bool nearly_same(const Pose& a, const Pose& b) {
    const double reach = 1 + std::max(a.translation.norm(), b.translation.norm());
    return (a.rotation - b.rotation).norm() < 1e-6 && (a.translation - b.translation).norm() < 1e-6 * reach;
}

} // namespace

bool same_timeline(const Timeline& a, const Timeline& b) {
    const auto same_angle = [](const AngleKey& x, const AngleKey& y) {
        return x.frame == y.frame && x.angle_rad == y.angle_rad;
    };
    const auto same_key = [](const PoseKey& x, const PoseKey& y) {
        return x.frame == y.frame && x.pose.rotation == y.pose.rotation &&
               x.pose.translation == y.pose.translation;
    };
    const auto same_track = [&](const BoneTrack& x, const BoneTrack& y) {
        return std::equal(x.keys.begin(), x.keys.end(), y.keys.begin(), y.keys.end(), same_key);
    };
    const bool same_hinge =
        a.hinge.has_value() == b.hinge.has_value() &&
        (!a.hinge || (a.hinge->centre == b.hinge->centre && a.hinge->axis == b.hinge->axis));
    return a.last_frame == b.last_frame && same_hinge &&
           std::equal(a.angles.begin(), a.angles.end(), b.angles.begin(), b.angles.end(), same_angle) &&
           std::equal(a.bone_tracks.begin(), a.bone_tracks.end(), b.bone_tracks.begin(), b.bone_tracks.end(),
                      same_track);
}

void set_hinge(Document& document, const Hinge& hinge, double angle_rad, const Phases& phases,
               const std::vector<int>& moving) {
    edit_hinge(document, {hinge, angle_rad, phases, moving});
    document.commit("Set motion");
}

void edit_hinge(Document& document, const HingeMotion& motion) {
    const int bones = static_cast<int>(document.scene().bones.size());
    for (const int bone : motion.moving)
        FASCICLE_ASSERT(bone >= 0 && bone < bones);
    if (!has_direction(motion.hinge.axis))
        throw_error("hinge axis", "it has no direction", "a direction", ErrorKind::usage);
    if (!motion.hinge.centre.allFinite() || !std::isfinite(motion.angle_rad))
        throw_error("hinge", "a number is not finite", "a place and an angle", ErrorKind::usage);
    if (motion.there_and_back) {
        Timeline timeline =
            make_hinge_timeline(motion.hinge, motion.angle_rad, motion.phases, bones, motion.moving);
        Scene& scene = document.edit();
        scene.timeline = std::move(timeline);
        scene.motion_source = {};
        return;
    }
    Scene& scene = document.edit();
    scene.timeline.hinge = motion.hinge;
    scene.timeline.bone_tracks.assign(static_cast<std::size_t>(bones), {});
    for (const int bone : motion.moving)
        give_hinge_track(scene, static_cast<std::size_t>(bone));
    scene.motion_source = {};
}

void set_hinge_angles(Document& document, const Hinge& hinge, std::vector<AngleKey> angles,
                      const std::vector<int>& moving, const std::string& name) {
    if (angles.size() < 2 || angles.front().frame != 0 || angles.front().angle_rad != 0 ||
        angles.back().frame > 1e6)
        throw_error(name, "the angles do not begin with 0 at frame 0, or are none, or too many",
                    "2 to 1000000 frames", ErrorKind::usage);
    for (std::size_t i = 1; i < angles.size(); ++i)
        if (!(std::abs(angles[i].angle_rad - angles[i - 1].angle_rad) <
              std::numbers::pi * (angles[i].frame - angles[i - 1].frame)))
            throw_error(name, "the bones would turn by half a turn or more in a frame", "more frames",
                        ErrorKind::usage);
    HingeMotion motion;
    motion.hinge = hinge;
    motion.moving = moving;
    motion.there_and_back = false;
    Timeline& timeline = document.edit().timeline;
    timeline.angles = std::move(angles);
    timeline.last_frame = static_cast<int>(std::ceil(timeline.angles.back().frame));
    try {
        edit_hinge(document, motion);
    } catch (...) {
        document.discard_edits();
        throw;
    }
    document.commit(name);
}

bool commit_motion(Document& document, const std::string& name) {
    if (!document.has_uncommitted_edits())
        return false;
    const Scene &now = document.scene(), &before = *document.head();
    if (same_timeline(now.timeline, before.timeline) && now.motion_source.path == before.motion_source.path) {
        document.discard_edits();
        return false;
    }
    return document.commit(name);
}

void set_timeline(Document& document, Timeline timeline, const MeshSource& source, const std::string& name) {
    FASCICLE_ASSERT(timeline.bone_tracks.size() <= document.scene().bones.size());
    Scene& scene = document.edit();
    scene.timeline = std::move(timeline);
    scene.motion_source = source;
    document.commit(name);
}

std::optional<HingeMotion> hinge_motion(const Scene& scene) {
    const Timeline& t = scene.timeline;
    if (!t.hinge)
        return std::nullopt;
    HingeMotion motion;
    motion.hinge = *t.hinge;
    for (std::size_t b = 0; b < std::min(scene.bones.size(), t.bone_tracks.size()); ++b) {
        const BoneTrack& track = t.bone_tracks[b];
        if (!std::all_of(track.keys.begin(), track.keys.end(), [&](const PoseKey& key) {
                return nearly_same(key.pose,
                                   rotation_about(t.hinge->centre, t.hinge->axis, t.angle_rad(key.frame)));
            }))
            return std::nullopt;
        if (!track.keys.empty())
            motion.moving.push_back(static_cast<int>(b));
    }
    // 0 -> angle -> 0, and then rest.
    const std::vector<AngleKey>& a = t.angles;
    const std::size_t n = a.size();
    motion.there_and_back =
        n <= 3 && (n == 0 || (a[0].frame == 0 && a[0].angle_rad == 0)) && (n < 3 || a[2].angle_rad == 0);
    motion.phases = {n > 1 ? static_cast<int>(a[1].frame) : 0,
                     n > 2 ? static_cast<int>(a[2].frame - a[1].frame) : 0, 0};
    motion.phases.rest = t.last_frame - motion.phases.out - motion.phases.back;
    motion.angle_rad = n > 1 ? a[1].angle_rad : 0;
    if (motion.phases.rest < 0 || motion.phases.total() < 1)
        motion.there_and_back = false;
    return motion;
}

bool set_bone_moving(Document& document, int bone, bool moving) {
    FASCICLE_ASSERT(bone >= 0 && bone < static_cast<int>(document.scene().bones.size()));
    const Timeline& timeline = document.scene().timeline;
    if (!timeline.hinge || bone_moves(document.scene(), bone) == moving)
        return false;
    Scene& scene = document.edit();
    const auto index = static_cast<std::size_t>(bone);
    if (moving)
        give_hinge_track(scene, index);
    else
        scene.timeline.bone_tracks[index] = {};
    if (bone_moves(scene, bone) != moving) { // a joint that never turns
        document.discard_edits();
        return false;
    }
    return document.commit((moving ? "Let move " : "Hold still ") + scene.bones[index].name);
}

bool bone_moves(const Scene& scene, int bone) {
    const std::vector<BoneTrack>& tracks = scene.timeline.bone_tracks;
    return bone >= 0 && bone < static_cast<int>(tracks.size()) &&
           tracks[static_cast<std::size_t>(bone)].moves();
}

} // namespace fascicle::actions
