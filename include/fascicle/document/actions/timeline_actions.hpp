#pragma once
// Changes of the motion. One undo step each.

#include "fascicle/document/document.hpp"

namespace fascicle::actions {

/// Whether the bones move alike, about the same joint.
bool same_timeline(const Timeline& a, const Timeline& b);

/// The bones listed in `moving` turn about the hinge to angle_rad and back. Error (usage) on bad phases or an
/// axis of length zero; the document is then as it was. Indices must be in range.
void set_hinge(Document& document, const Hinge& hinge, double angle_rad, const Phases& phases,
               const std::vector<int>& moving);

/// What a motion about one joint is made of.
struct HingeMotion {
    Hinge hinge;
    double angle_rad = 0;
    Phases phases;
    std::vector<int> moving; ///< bones, ascending
    /// The angle goes out and back over the phases, as set_hinge() makes it. Otherwise the timeline's own angles stay (of a file), and
    /// angle_rad and phases mean nothing.
    bool there_and_back = true;
};
/// The motion that the timeline holds: nothing without a joint, or when a bone has keys that do not turn with it.
std::optional<HingeMotion> hinge_motion(const Scene& scene);

/// The bones listed turn about the hinge by angles of any course, the first one 0 at frame 0, frames ascending. One step. Error
/// (usage) for another first angle, half a turn or more in a frame, more than a million frames.
void set_hinge_angles(Document& document, const Hinge& hinge, std::vector<AngleKey> angles,
                      const std::vector<int>& moving, const std::string& name);

/// As set_hinge, on the scratch: for as long as a slider is held. commit_motion() ends the drag.
void edit_hinge(Document& document, const HingeMotion& motion);
/// Makes the drag one step of that name; one that came back to where it began is no step (false).
bool commit_motion(Document& document, const std::string& name = "Set motion");
/// Another timeline, one track a bone at most. One step.
void set_timeline(Document& document, Timeline timeline, const MeshSource& source, const std::string& name);

/// Turn about an axis through a point, and a slide along it: what carries a bone from rest to a key. Any rigid motion is one
/// (Chasles).
struct Screw {
    Vec3 centre = Vec3::Zero(); ///< the point of the axis nearest to `near` of screw_of()
    Vec3 axis = Vec3::UnitX();  ///< unit vector
    double angle_rad = 0;       ///< 0 to pi; a shift alone has 0, its direction as axis
    double slide = 0;           ///< scene units along the axis
};
Screw screw_of(const Pose& pose, const Vec3& near);
/// Error (usage) for an axis of length zero.
Pose pose_of(const Screw& screw);

/// Keys of single bones, one undo step each. Frame 0 is rest and cannot be set or removed. The joint of the timeline stays while all
/// that moves turns with its angle; else it is the one about which all keys turn alike, or none. Error (usage) when a bone would turn by half a
/// turn or more between neighbouring keys, or the frame is not within 1 to 1000000; the document is then as it was.
void set_pose_key(Document& document, int bone, double frame, const Pose& pose);
/// The same on the scratch, for as long as a slider is held; the key must be there. commit_motion() ends the drag.
void edit_pose_key(Document& document, int bone, std::size_t key, const Pose& pose);
/// Moves a key to another frame, which must be free.
void move_pose_key(Document& document, int bone, std::size_t key, double frame);
void remove_pose_key(Document& document, int bone, std::size_t key);
/// Number of the last frame, 1 to 1000000; keys behind it stay. False, and no step, when nothing changes.
bool set_last_frame(Document& document, int last_frame);

/// Lets a bone turn with the timeline's joint, or stay at rest. False, and no step, when nothing changes or the
/// timeline has no joint.
bool set_bone_moving(Document& document, int bone, bool moving);

/// Whether the bone has a track that moves it.
bool bone_moves(const Scene& scene, int bone);

} // namespace fascicle::actions
