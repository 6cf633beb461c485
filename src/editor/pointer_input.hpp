#pragma once
// The pointer of this frame as ImGui knows it, for whatever shows a scene.

#include "editor/editor_context.hpp"
#include "editor/viewport_pointer.hpp"

namespace fascicle::editor {

/// In pixels from the area's upper left corner. inside: the pointer is over it, and nothing is in front.
PointerInput pointer_input(const EditorContext& context, const Rect& area, bool inside);

} // namespace fascicle::editor
