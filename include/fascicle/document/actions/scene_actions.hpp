#pragma once
// Bones and muscles come and go. One undo step each. Indices must be in range.

#include "fascicle/document/document.hpp"

namespace fascicle::actions {

/// Appends and returns the index. A name that another bone or muscle has gets a number behind it ("femur 2").
/// The mesh must not be null. A bone that is `moving` turns with the timeline's joint, when there is one.
int add_bone(Document& document, Bone bone, bool moving = false);
int add_muscle(Document& document, Muscle muscle);

/// The bone's track, the attachments to it and the areas on it go with it; other indices are adjusted.
void remove_bone(Document& document, int bone);
void remove_muscle(Document& document, int muscle);

/// False, and no step, when the name is empty, unchanged or taken.
bool rename_bone(Document& document, int bone, const std::string& name);
bool rename_muscle(Document& document, int muscle, const std::string& name);

} // namespace fascicle::actions
