#include "fascicle/document/actions/timeline_actions.hpp"

#include "document/actions/hinge_track.hpp"
#include "fascicle/base/error.hpp"

namespace fascicle::actions {

void set_hinge(Document& document, const Hinge& hinge, double angle_rad, const Phases& phases,
               const std::vector<int>& moving) {
    const int bones = static_cast<int>(document.scene().bones.size());
    for (const int bone : moving)
        FASCICLE_ASSERT(bone >= 0 && bone < bones);
    if (!(hinge.axis.norm() > 0))
        throw_error("hinge axis", "its length is zero", "a direction", ErrorKind::usage);
    Timeline timeline = make_hinge_timeline(hinge, angle_rad, phases, bones, moving);
    Scene& scene = document.edit();
    scene.timeline = std::move(timeline);
    scene.motion_source = {};
    document.commit("Set motion");
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
