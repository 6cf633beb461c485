#pragma once
// Changes of the whole scene at once.

#include "fascicle/document/document.hpp"

namespace fascicle::actions {

/// Another version of the scene in its place, as one undo step: files that were read anew.
void replace_scene(Document& document, Scene scene, std::string step_name);

} // namespace fascicle::actions
