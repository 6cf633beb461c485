#pragma once
// Changes of the motion. One undo step each.

#include "fascicle/document/document.hpp"

namespace fascicle::actions {

/// The bones listed in `moving` turn about the hinge to angle_rad and back. Error (usage) on bad phases or an
/// axis of length zero; the document is then as it was. Indices must be in range.
void set_hinge(Document& document, const Hinge& hinge, double angle_rad, const Phases& phases,
               const std::vector<int>& moving);

/// Lets a bone turn with the timeline's joint, or stay at rest. False, and no step, when nothing changes or the
/// timeline has no joint.
bool set_bone_moving(Document& document, int bone, bool moving);

/// Whether the bone has a track that moves it.
bool bone_moves(const Scene& scene, int bone);

} // namespace fascicle::actions
