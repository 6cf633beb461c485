#pragma once
// The command that shows where contact is worst.

#include "editor/editor_context.hpp"

namespace fascicle::editor {

/// Half the width of what is shown around the vertex.
inline constexpr double worst_vertex_surroundings_mm = 15;

/// Frames the camera, at its present angles, on the worst vertex (metrics/worst_vertex.hpp) of the shown frame, and says
/// in the message log which muscle, vertex and bone it is and how deep or how far. A warning in the log, and nothing
/// else, when there is no such vertex. Takes about as long as making the trees of all bones.
void fly_to_worst(EditorContext& context);

} // namespace fascicle::editor
